#include "moving_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "driven_motion.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/convert.h"
#include "sluice/solids/mass_properties.h"
#include "sluice/solids/slide.h"

namespace sluice::sim {

namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

/// Share of the usual clearance that is kept from a body whose samples lie half a spacing within: fluid at rest comes
/// as close as that to its surface.
constexpr double kInsetClearance = 0.3;

Vector3d toVector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

bool feltAsMoving(const v1::Body& body) { return moves(body) || body.has_floating() || body.friction() > 0; }

BodySums& BodySums::operator+=(const BodySums& other) {
  if (ofBody.empty()) ofBody.resize(other.ofBody.size(), Vector6d::Zero());
  for (std::size_t k = 0; k < other.ofBody.size(); ++k) ofBody[k] += other.ofBody[k];
  return *this;
}

MovingBodies::MovingBodies(const Bodies::List& bodies, const Container& container, const Discretisation& discretisation,
                           int layers)
    : origin_(toVector(container.origin)) {
  if (container.plane) return;
  for (int k = 0; k < bodies.size(); ++k) {
    const v1::Body& settings = bodies[k];
    const Isometry3d pose = scene::toPose(settings).cast<double>();
    scenePoses_.push_back({pose.translation().cast<float>(), Eigen::Quaternionf(pose.rotation().cast<float>())});
    const bool floats = settings.has_floating() && settings.solid();
    if (!(settings.solid() ? feltAsMoving(settings) : moves(settings))) continue;
    const std::string path = "bodies[" + std::to_string(k) + "]";
    Moving moving{{solids::makeBodyShape(settings, path), settings.has_glass(), startingPose(settings)},
                  {},
                  settings,
                  {},
                  static_cast<std::size_t>(k),
                  settings.solid()};
    moving.sampling = {discretisation.spacing, 0, 1};
    // Half a spacing within the surface, where that leaves a lattice to sample: what floats displaces its own volume.
    const bool isThick = moving.body.shape().bounds().sizes().minCoeff() > 2 * discretisation.spacing;
    if (moving.body.isSolid()) {
      moving.sampling = {discretisation.spacing, isThick ? 0.5 * discretisation.spacing : 0, layers};
    }
    moving.friction = settings.friction();
    if (floats) {
      const auto mass = solids::massPropertiesOf(settings, moving.body.shape(), path + ".floating");
      const double density = settings.floating().density();
      moving.mass = density * mass.volume;
      moving.centreOfMass = mass.centre;
      moving.inertia = density * mass.inertia;
    }
    const Eigen::AlignedBox3d own = moving.body.shape().bounds();
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d x = own.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      moving.radius = std::max(moving.radius, (x - moving.centreOfMass).norm());
    }
    anyFloats_ = anyFloats_ || floats;
    anyMoves_ = anyMoves_ || floats || moves(settings);
    anyAdheres_ = anyAdheres_ || (moving.holdsFluid && settings.adhesion() > 0);
    anyRubs_ = anyRubs_ || (moving.holdsFluid && moving.friction > 0);
    bodies_.push_back(std::move(moving));
  }
  state_.resize(bodies_.size());
  reset();
  if (!anyFloats_) return;
  std::vector<RigidPart> parts;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Moving& moving = bodies_[k];
    parts.push_back({&moving.settings, &moving.body.shape(), moving.mass, moving.centreOfMass, moving.inertia,
                     moving.holdsFluid, state_[k]});
  }
  std::vector<std::unique_ptr<const solids::BodyShape>> shapes;
  for (int k = 0; k < bodies.size(); ++k) {
    if (!bodies[k].solid() || feltAsMoving(bodies[k])) continue;
    shapes.push_back(solids::makeBodyShape(bodies[k], "bodies[" + std::to_string(k) + "]"));
    const Isometry3d pose = startingPose(bodies[k]);
    RigidPart stands;
    stands.settings = &bodies[k];
    stands.shape = shapes.back().get();
    stands.start = {pose.translation(), Quaterniond(pose.rotation()).normalized(), Vector6d::Zero()};
    parts.push_back(stands);
  }
  world_ = std::make_shared<const RigidWorld>(parts, container, discretisation.spacing);
}

Isometry3d MovingBodies::startingPose(const v1::Body& body) const {
  Isometry3d pose = scene::toPose(body).cast<double>();
  pose.pretranslate(-origin_);
  return pose;
}

void MovingBodies::reset() {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Moving& moving = bodies_[k];
    const Isometry3d pose = startingPose(moving.settings);
    state_[k] = {pose * moving.centreOfMass, Quaterniond(pose.rotation()).normalized(), Vector6d::Zero()};
    if (moving.mass > 0) {
      state_[k].twist << scene::toVector(moving.settings.floating().velocity()),
          kDegree * scene::toVector(moving.settings.floating().spin());
    }
    place(k);
  }
  settle();
}

void MovingBodies::place(std::size_t k) {
  Moving& moving = bodies_[k];
  Isometry3d pose = Isometry3d::Identity();
  pose.translate(state_[k].position);
  pose.rotate(state_[k].rotation);
  pose.translate(-moving.centreOfMass);
  moving.body.moveTo(pose);
}

Isometry3d MovingBodies::wayOf(const Moving& body, double time) const {
  return drivenPose(body.settings.driven(), startingPose(body.settings), time);
}

void MovingBodies::drive(double time, double seconds) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (!bodies_[k].settings.has_driven()) continue;
    state_[k].twist = twistBetween(wayOf(bodies_[k], time), wayOf(bodies_[k], time + seconds), seconds);
  }
}

void MovingBodies::accelerate(const Vector3d& change) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (floats(k)) state_[k].twist.head<3>() += change;
  }
}

void MovingBodies::advance(double time, double seconds) {
  settle();
  if (world_) world_->step(state_, seconds);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (bodies_[k].settings.has_driven()) {
      const Isometry3d pose = wayOf(bodies_[k], time + seconds);
      state_[k].position = pose.translation();
      state_[k].rotation = Quaterniond(pose.rotation()).normalized();
    }
    place(k);
  }
}

void MovingBodies::settle() {
  for (Moving& moving : bodies_) moving.before = moving.body.pose();
}

double MovingBodies::largestSpeed(double time, double seconds) const {
  double largest = 0;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Moving& moving = bodies_[k];
    if (moving.settings.has_driven()) {
      largest = std::max(largest, drivenSpeed(moving.settings.driven(), moving.radius, time + seconds));
    } else {
      largest = std::max(largest, state_[k].twist.head<3>().norm() + state_[k].twist.tail<3>().norm() * moving.radius);
    }
  }
  return largest;
}

Eigen::Matrix<double, 6, 6> MovingBodies::massMatrix(std::size_t k) const {
  const Eigen::Matrix3d turn = state_[k].rotation.toRotationMatrix();
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  matrix.topLeftCorner<3, 3>() = bodies_[k].mass * Eigen::Matrix3d::Identity();
  matrix.bottomRightCorner<3, 3>() = turn * bodies_[k].inertia * turn.transpose();
  return matrix;
}

Eigen::Matrix<double, 6, 6> MovingBodies::inverseMass(std::size_t k) const {
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  if (!floats(k)) return matrix;
  const Eigen::Matrix3d turn = state_[k].rotation.toRotationMatrix();
  matrix.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / bodies_[k].mass;
  matrix.bottomRightCorner<3, 3>() = turn * bodies_[k].inertia.inverse() * turn.transpose();
  return matrix;
}

void MovingBodies::push(const BodySums& momentum) {
  for (std::size_t k = 0; k < momentum.ofBody.size(); ++k) {
    if (floats(k)) state_[k].twist += inverseMass(k) * momentum.ofBody[k];
  }
}

bool MovingBodies::deflect(const Vector3d& x, Vector3d& velocity, Vector3d& to, double clearance,
                           BodyPush& push) const {
  bool held = false;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Moving& moving = bodies_[k];
    if (!moving.holdsFluid) continue;
    // As the body sees it: where the particle was, carried along with it, is where its way begins.
    const double kept = moving.sampling.inset > 0 ? kInsetClearance * clearance : clearance;
    Vector3d carried = moving.body.pose() * (moving.before.inverse() * x);
    const double reach = (to - carried).norm() + 2 * kept;
    if (moving.body.bounds().squaredExteriorDistance(carried) >= reach * reach) continue;
    const auto touch = [&](const Vector3d& normal, const Vector3d& at) {
      const Vector3d wall = state_[k].twist.head<3>() + state_[k].twist.tail<3>().cross(at - state_[k].position);
      Vector3d relative = velocity - wall;
      if (!solids::takeOutInward(relative, normal)) return;
      const Vector3d taken = push.particleMass * (velocity - (wall + relative));
      velocity = wall + relative;
      if (!floats(k)) return;
      push.momenta.ofBody.resize(bodies_.size(), Vector6d::Zero());
      push.momenta.ofBody[k].head<3>() += taken;
      push.momenta.ofBody[k].tail<3>() += (at - state_[k].position).cross(taken);
    };
    Vector3d place = carried;
    const bool stopped = solids::slide(
        place, to, kept, [&](const Vector3d& from, double far) { return moving.body.closest(from, far); }, touch,
        [](const Vector3d&) { return false; });
    bool pushedOut = false;
    if (moving.body.contains(place)) {
      const solids::ClosestPoint out = moving.body.closest(place, std::numeric_limits<double>::infinity());
      if (out.distance > 0) {
        const Vector3d normal = (out.point - place) / out.distance;
        touch(normal, out.point);
        place = out.point + kept * normal;
        pushedOut = true;
      }
    }
    if (!stopped && !pushedOut) continue;
    to = place;
    held = true;
  }
  return held;
}

bool MovingBodies::anyAt(const Vector3d& x, double distance) const {
  return std::ranges::any_of(
      bodies_, [&](const Moving& moving) { return moving.holdsFluid && moving.body.isNearer(x, distance); });
}

bool MovingBodies::near(const Vector3d& x, double reach) const {
  return std::ranges::any_of(bodies_, [&](const Moving& moving) {
    return moving.holdsFluid && moving.body.bounds().squaredExteriorDistance(x) < reach * reach;
  });
}

std::vector<core::BodyPose> MovingBodies::poses() const {
  if (!anyMoves_) return {};
  std::vector<core::BodyPose> poses = scenePoses_;
  for (const Moving& moving : bodies_) {
    const Isometry3d& pose = moving.body.pose();
    poses[moving.inScene] = {(pose.translation() + origin_).cast<float>(),
                             Eigen::Quaternionf(Quaterniond(pose.rotation()).cast<float>())};
  }
  return poses;
}

void MovingBodies::restore(const State& state) {
  SLUICE_CHECK_EQ(state.size(), state_.size());
  state_ = state;
  for (std::size_t k = 0; k < bodies_.size(); ++k) place(k);
  settle();
}

void MovingBodies::save(core::StateWriter& out) const {
  std::vector<double> numbers;
  for (const RigidState& s : state_) {
    numbers.insert(numbers.end(), s.position.begin(), s.position.end());
    numbers.insert(numbers.end(), s.rotation.coeffs().begin(), s.rotation.coeffs().end());
    // Driven bodies get theirs at the beginning of a step.
    const Vector6d twist = bodies_[static_cast<std::size_t>(&s - state_.data())].mass > 0 ? s.twist : Vector6d::Zero();
    numbers.insert(numbers.end(), twist.begin(), twist.end());
  }
  out.write(numbers);
}

void MovingBodies::resume(core::StateReader& in) {
  constexpr std::size_t kEach = 13;
  std::vector<double> numbers;
  in.read(numbers);
  if (numbers.size() != kEach * state_.size()) in.fail("the bodies that move are not those of the state's scene");
  State state(state_.size());
  for (std::size_t k = 0; k < state.size(); ++k) {
    const double* from = &numbers[kEach * k];
    state[k].position = Eigen::Map<const Vector3d>(from);
    state[k].rotation.coeffs() = Eigen::Map<const Eigen::Vector4d>(from + 3);
    state[k].twist = Eigen::Map<const Vector6d>(from + 7);
    if (!std::all_of(from, from + kEach, [](double n) { return std::isfinite(n); })) in.fail("a body is nowhere");
  }
  restore(state);
}

}  // namespace sluice::sim
