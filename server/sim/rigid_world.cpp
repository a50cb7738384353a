#include "rigid_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <btBulletDynamicsCommon.h>
#include <Eigen/Eigenvalues>

#include "sluice/scene/convert.h"
#include "sluice/solids/placed_body.h"

namespace sluice::sim {

namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Planes that stand for a round container: around a cylinder, and along each meridian of a sphere. Between them a
/// body reaches R(1 - cos(π/64)), a thousandth of the radius, behind the wall.
constexpr int kPlanesAround = 64;

/// Faces of a round vessel's mantle.
constexpr int kFacesOfMantle = 48;

/// Bullet's margin around shapes, in spacings: its usual 4 cm are more than a small scene's particles.
constexpr double kMargin = 0.1;

btVector3 toBullet(const Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
btQuaternion toBullet(const Quaterniond& q) {
  return {static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()), static_cast<btScalar>(q.z()),
          static_cast<btScalar>(q.w())};
}
Vector3d toEigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
Quaterniond toEigen(const btQuaternion& q) { return Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized(); }

using Triangles = std::vector<std::array<Vector3d, 3>>;

void addQuad(Triangles& triangles, const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

/// Floor and walls of a vessel without a lid, `outline` going around it at half its height.
Triangles vessel(const std::vector<Vector3d>& outline, double half) {
  Triangles triangles;
  const Vector3d up = half * Vector3d::UnitY();
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vector3d& a = outline[k];
    const Vector3d& b = outline[(k + 1) % outline.size()];
    addQuad(triangles, a - up, b - up, b + up, a + up);
    triangles.push_back({-up, a - up, b - up});
  }
  return triangles;
}

/// Surface of a shape that is not convex; empty for those that are.
Triangles hollowSurface(const v1::Body& body, const solids::BodyShape& shape) {
  if (body.has_mesh()) return shape.triangles();
  if (shape.isClosed()) return {};
  if (body.has_cylinder()) {
    std::vector<Vector3d> outline;
    for (int k = 0; k < kFacesOfMantle; ++k) {
      const double angle = 2 * std::numbers::pi * k / kFacesOfMantle;
      outline.push_back(body.cylinder().radius() * Vector3d(std::cos(angle), 0, std::sin(angle)));
    }
    return vessel(outline, 0.5 * body.cylinder().height());
  }
  const Vector3d h = 0.5 * scene::toVector(body.box().size());
  return vessel({{h.x(), 0, h.z()}, {-h.x(), 0, h.z()}, {-h.x(), 0, -h.z()}, {h.x(), 0, -h.z()}}, h.y());
}

}  // namespace

struct RigidWorld::Parts {
  /// From Bullet's axes of a body, which are the principal ones about its centre of mass, to its own ones.
  struct Part {
    std::unique_ptr<btTriangleMesh> mesh;
    std::unique_ptr<btCollisionShape> inner;
    std::unique_ptr<btCollisionShape> shape;
    double mass = 0;
    Quaterniond principal = Quaterniond::Identity();
    Vector3d moments = Vector3d::Zero();
    double restitution = 1;
    double friction = 1;
    bool collides = true;
    RigidState start;
  };
  std::vector<Part> parts;
  std::vector<std::unique_ptr<btCollisionShape>> faces;
  double spacing = 0;
};

namespace {

std::unique_ptr<btCollisionShape> convexShape(const v1::Body& body, const solids::BodyShape& shape) {
  if (body.has_sphere()) return std::make_unique<btSphereShape>(static_cast<btScalar>(body.sphere().radius()));
  if (body.has_cylinder()) {
    const double r = body.cylinder().radius();
    return std::make_unique<btCylinderShape>(toBullet({r, 0.5 * body.cylinder().height(), r}));
  }
  if (body.has_mesh()) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const auto& triangle : shape.triangles()) {
      for (const Vector3d& corner : triangle) hull->addPoint(toBullet(corner), false);
    }
    hull->recalcLocalAabb();
    return hull;
  }
  return std::make_unique<btBoxShape>(toBullet(0.5 * scene::toVector(body.box().size())));
}

}  // namespace

RigidWorld::RigidWorld(const std::vector<RigidPart>& parts, const Container& container, double spacing)
    : parts_(std::make_unique<Parts>()) {
  parts_->spacing = spacing;
  const auto margin = static_cast<btScalar>(kMargin * spacing);
  for (const RigidPart& given : parts) {
    Parts::Part& part = parts_->parts.emplace_back();
    part.mass = given.mass;
    part.collides = given.collides;
    part.start = given.start;
    if (given.settings->has_floating()) {
      part.restitution = given.settings->floating().restitution();
      part.friction = given.settings->floating().sliding_friction();
    }
    const Triangles hollow = given.mass > 0 ? Triangles() : hollowSurface(*given.settings, *given.shape);
    if (hollow.empty()) {
      part.inner = convexShape(*given.settings, *given.shape);
    } else {
      part.mesh = std::make_unique<btTriangleMesh>();
      for (const auto& [a, b, c] : hollow) part.mesh->addTriangle(toBullet(a), toBullet(b), toBullet(c));
      part.inner = std::make_unique<btBvhTriangleMeshShape>(part.mesh.get(), true);
    }
    // A sphere's margin is its radius.
    if (!given.settings->has_sphere()) part.inner->setMargin(margin);
    btTransform toPrincipal = btTransform::getIdentity();
    if (given.mass > 0) {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(given.inertia);
      Eigen::Matrix3d turn = axes.eigenvectors();
      if (turn.determinant() < 0) turn.col(0) *= -1;
      part.principal = Quaterniond(turn);
      part.moments = axes.eigenvalues();
      const Quaterniond back = part.principal.conjugate();
      toPrincipal = btTransform(toBullet(back), toBullet(Vector3d(back * -given.centreOfMass)));
    }
    auto compound = std::make_unique<btCompoundShape>();
    compound->addChildShape(toPrincipal, part.inner.get());
    part.shape = std::move(compound);
  }
  const auto addPlane = [&](const Vector3d& inward, double offset) {
    parts_->faces.push_back(std::make_unique<btStaticPlaneShape>(toBullet(inward), static_cast<btScalar>(offset)));
  };
  if (!container.enclosure) {
    for (int axis = 0; axis < 3; ++axis) {
      addPlane(Vector3d::Unit(axis), 0);
      addPlane(-Vector3d::Unit(axis), -container.size[static_cast<std::size_t>(axis)]);
    }
    return;
  }
  for (const auto& plane : container.enclosure->planes()) addPlane(plane.normal, plane.offset);
  if (!container.enclosure->round()) return;
  const auto& round = *container.enclosure->round();
  const auto addTangent = [&](const Vector3d& outward) {
    addPlane(-outward, -outward.dot(round.centre) - round.radius);
  };
  const int rings = round.isUpright ? 1 : kPlanesAround / 2 - 1;
  for (int ring = 1; ring <= rings; ++ring) {
    const double polar = std::numbers::pi * ring / (rings + 1);
    for (int k = 0; k < kPlanesAround; ++k) {
      const double angle = 2 * std::numbers::pi * k / kPlanesAround;
      addTangent({std::sin(polar) * std::cos(angle), std::cos(polar), std::sin(polar) * std::sin(angle)});
    }
  }
  if (round.isUpright) return;
  addTangent(Vector3d::UnitY());
  addTangent(-Vector3d::UnitY());
}

RigidWorld::~RigidWorld() = default;

void RigidWorld::step(std::vector<RigidState>& states, double seconds) const {
  btDefaultCollisionConfiguration configuration;
  // Several points of contact at once: there are no earlier steps to collect them from.
  configuration.setConvexConvexMultipointIterations(4, 4);
  configuration.setPlaneConvexMultipointIterations(4, 4);
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity({0, 0, 0});
  world.getSolverInfo().m_numIterations = 30;

  std::vector<std::unique_ptr<btDefaultMotionState>> motions;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<btRigidBody*> moving;  // Of each part; null where it does not collide.
  const auto add = [&](const btTransform& pose, double mass, btCollisionShape* shape, const Vector3d& moments) {
    motions.push_back(std::make_unique<btDefaultMotionState>(pose));
    btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(mass), motions.back().get(), shape,
                                                  toBullet(moments));
    bodies.push_back(std::make_unique<btRigidBody>(info));
    return bodies.back().get();
  };
  for (std::size_t k = 0; k < parts_->parts.size(); ++k) {
    const Parts::Part& part = parts_->parts[k];
    if (!part.collides) {
      moving.push_back(nullptr);
      continue;
    }
    const bool stands = k >= states.size();
    const RigidState& state = stands ? part.start : states[k];
    const btTransform pose(toBullet(Quaterniond(state.rotation * part.principal)), toBullet(state.position));
    btRigidBody* body = add(pose, part.mass, part.shape.get(), part.moments);
    moving.push_back(body);
    // Bullet multiplies those of the two that meet.
    body->setRestitution(static_cast<btScalar>(part.restitution));
    body->setFriction(static_cast<btScalar>(part.friction));
    if (stands) continue;
    const btVector3 velocity = toBullet(Vector3d(state.twist.head<3>()));
    const btVector3 spin = toBullet(Vector3d(state.twist.tail<3>()));
    body->setLinearVelocity(velocity);
    body->setAngularVelocity(spin);
    body->setActivationState(DISABLE_DEACTIVATION);
    if (part.mass > 0) continue;
    // Bullet takes a driven body's velocity from where it was and where it is to be.
    body->setCollisionFlags(body->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    btTransform next;
    btTransformUtil::integrateTransform(pose, velocity, spin, static_cast<btScalar>(seconds), next);
    motions.back()->setWorldTransform(next);
  }
  for (const auto& face : parts_->faces) {
    btRigidBody* wall = add(btTransform::getIdentity(), 0, face.get(), Vector3d::Zero());
    wall->setRestitution(1);
    wall->setFriction(1);
  }
  for (const auto& body : bodies) world.addRigidBody(body.get());
  world.stepSimulation(static_cast<btScalar>(seconds), 0);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Parts::Part& part = parts_->parts[k];
    if (part.mass == 0) continue;
    const btTransform& pose = moving[k]->getWorldTransform();
    states[k].position = toEigen(pose.getOrigin());
    states[k].rotation = (toEigen(pose.getRotation()) * part.principal.conjugate()).normalized();
    states[k].twist << toEigen(moving[k]->getLinearVelocity()), toEigen(moving[k]->getAngularVelocity());
  }
  for (const auto& body : bodies) world.removeRigidBody(body.get());
}

}  // namespace sluice::sim
