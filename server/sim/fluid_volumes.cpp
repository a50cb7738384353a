#include "fluid_volumes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>

#include <Eigen/Geometry>

#include "sluice/core/input_error.h"
#include "sluice/scene/convert.h"
#include "sluice/solids/body_shape.h"

namespace sluice::sim {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr char kAxes[] = "xyz";

/// Share of a spacing by which decimal fractions miss the points of a lattice.
constexpr double kRounding = 1e-6;

Vector3d originOf(const Container& container) { return Vector3d::Map(container.origin.data()); }

std::string elementPath(int fluid, const char* list, int index) {
  return "simulation.fluids[" + std::to_string(fluid) + "]." + list + "[" + std::to_string(index) + "]";
}

/// Lays the common lattice over a box, as far as it lies in the container, and one layer farther: enough to find what
/// reaches out.
void layLattice(FluidVolume& volume, const AlignedBox3d& bounds, const Container& container, double spacing) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double first = std::max(std::ceil(bounds.min()[a] / spacing - kRounding), 0.0);
    const double last =
        std::min(std::floor(bounds.max()[a] / spacing + kRounding), std::ceil(container.size[axis] / spacing));
    volume.first[axis] = first * spacing;
    volume.counts[axis] = last < first ? 0 : static_cast<std::uint32_t>(last - first) + 1;
  }
  if (container.plane) {
    volume.first[2] = *container.plane;
    volume.counts[2] = 1;
  }
}

/// Throws where the volume, in a planar scene, is not at the plane's height or does not move within it.
void checkPlanar(const FluidVolume& volume, double z, const Container& container) {
  if (!container.plane) return;
  const double plane = container.origin[2] + *container.plane;
  if (std::abs(z - plane) > kPlaneTolerance) {
    std::ostringstream problem;
    problem << "the scene is planar: z must be that of its first volume, " << plane << " m";
    throw core::InputError("", volume.place + ".z", problem.str());
  }
  if (volume.velocity.z() != 0) {
    throw core::InputError("", volume.path + ".velocity.z", "must be 0: the scene is planar");
  }
}

FluidVolume volumeOf(int fluid, const char* noun, const std::string& path, const char* place,
                     const v1::Vec3& velocity) {
  FluidVolume volume;
  volume.noun = noun;
  volume.path = path;
  volume.place = path + "." + place;
  volume.fluid = fluid;
  volume.velocity = velocity;
  return volume;
}

FluidVolume blockVolume(const v1::Block& block, int fluid, const std::string& path, const Container& container) {
  FluidVolume volume = volumeOf(fluid, "block", path, "first_particle", block.velocity());
  if (container.plane && block.count_z() != 1) {
    throw core::InputError("", path + ".count_z", "must be 1: the scene is planar");
  }
  checkPlanar(volume, block.first_particle().z(), container);
  const Vector3d first = scene::toVector(block.first_particle()) - originOf(container);
  volume.first = {first.x(), first.y(), first.z()};
  volume.counts = {block.count_x(), block.count_y(), block.count_z()};
  volume.expected = double{1} * block.count_x() * block.count_y() * block.count_z();
  return volume;
}

FluidVolume ballVolume(const v1::Ball& ball, int fluid, const std::string& path, const Container& container,
                       double spacing) {
  FluidVolume volume = volumeOf(fluid, "ball", path, "centre", ball.velocity());
  checkPlanar(volume, ball.centre().z(), container);
  const Vector3d centre = scene::toVector(ball.centre()) - originOf(container);
  const AlignedBox3d bounds(Vector3d(centre.array() - ball.radius()), Vector3d(centre.array() + ball.radius()));
  layLattice(volume, bounds, container, spacing);
  const double radii = ball.radius() / spacing;
  const double ofBall =
      container.plane ? std::numbers::pi * radii * radii : 4 * std::numbers::pi / 3 * radii * radii * radii;
  // What reaches out of the container is refused for that, however large it is.
  volume.expected = std::min(ofBall, double{1} * volume.counts[0] * volume.counts[1] * volume.counts[2]);
  // Points on the surface are outside: otherwise rounding would say on which side of it they are.
  const double reach = ball.radius() - kRounding * spacing;
  volume.contains = [centre, reach](const Vector3d& x) { return (x - centre).squaredNorm() < reach * reach; };
  return volume;
}

FluidVolume meshVolume(const v1::MeshVolume& settings, int fluid, const std::string& path, const Container& container,
                       double spacing) {
  FluidVolume volume = volumeOf(fluid, "mesh", path, "position", settings.velocity());
  if (container.plane) throw core::InputError("", path, "the scene is planar: it takes blocks, balls and emitters");
  v1::Body body;
  body.mutable_mesh()->set_path(settings.path());
  body.mutable_mesh()->set_scale(settings.scale());
  *body.mutable_position() = settings.position();
  *body.mutable_rotation_degrees() = settings.rotation_degrees();
  std::shared_ptr<const solids::BodyShape> shape;
  try {
    shape = solids::makeBodyShape(body, path);
  } catch (const core::InputError& error) {
    throw core::InputError("", path + ".path", error.problem());
  }
  if (!shape->isClosed()) {
    throw core::InputError("", path + ".path",
                           settings.path() +
                               " has edges that do not have two faces: an open surface has no inside "
                               "that could be filled");
  }
  Eigen::Isometry3d pose = scene::toPose(body).cast<double>();
  pose.pretranslate(-originOf(container));
  AlignedBox3d bounds;
  for (int corner = 0; corner < 8; ++corner) {
    bounds.extend(pose * shape->bounds().corner(static_cast<AlignedBox3d::CornerType>(corner)));
  }
  layLattice(volume, bounds, container, spacing);
  volume.contains = [shape, toMesh = pose.inverse()](const Vector3d& x) { return shape->contains(toMesh * x); };
  return volume;
}

/// The same for the faces of a container that is no plain box.
void checkInEnclosure(const FluidVolume& volume, const Vector3d& x, const solids::Enclosure& enclosure,
                      double spacing) {
  const double distance = enclosure.distance(x);
  if (distance >= kClearance * spacing) return;
  std::ostringstream problem;
  problem << "the " << volume.noun << " has a particle " << distance << " m inside the container and its planes; "
          << "particles must start one spacing inside, " << spacing << " m";
  throw core::InputError("", volume.place, problem.str());
}

double placeOf(const FluidVolume& volume, std::size_t axis, std::uint32_t step, double spacing) {
  return volume.first[axis] + spacing * step;
}

/// The corners of a volume's lattice, which must not be empty.
std::array<Vector3d, 8> cornersOf(const FluidVolume& volume, double spacing) {
  std::array<Vector3d, 8> corners;
  for (unsigned k = 0; k < 8; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t step = (k >> axis & 1) == 0 ? 0 : volume.counts[axis] - 1;
      corners[k][static_cast<Eigen::Index>(axis)] = placeOf(volume, axis, step, spacing);
    }
  }
  return corners;
}

}  // namespace

std::vector<FluidVolume> fluidVolumes(const v1::Simulation& simulation, const Container& container) {
  const double spacing = simulation.particle_spacing();
  std::vector<FluidVolume> volumes;
  for (int f = 0; f < simulation.fluids_size(); ++f) {
    const v1::Fluid& fluid = simulation.fluids(f);
    const std::size_t before = volumes.size();
    for (int k = 0; k < fluid.blocks_size(); ++k) {
      volumes.push_back(blockVolume(fluid.blocks(k), f, elementPath(f, "blocks", k), container));
    }
    for (int k = 0; k < fluid.balls_size(); ++k) {
      volumes.push_back(ballVolume(fluid.balls(k), f, elementPath(f, "balls", k), container, spacing));
    }
    for (int k = 0; k < fluid.meshes_size(); ++k) {
      volumes.push_back(meshVolume(fluid.meshes(k), f, elementPath(f, "meshes", k), container, spacing));
    }
    if (volumes.size() > before || fluid.emitters_size() > 0) continue;
    throw core::InputError("", "simulation.fluids[" + std::to_string(f) + "]",
                           "has no blocks, balls, meshes or emitters; it needs at least one of them");
  }
  return volumes;
}

void forEachPlace(const FluidVolume& volume, double spacing, const std::function<void(const Vector3d&)>& visit) {
  for (std::uint32_t k = 0; k < volume.counts[2]; ++k) {
    for (std::uint32_t j = 0; j < volume.counts[1]; ++j) {
      for (std::uint32_t i = 0; i < volume.counts[0]; ++i) {
        const Vector3d x(placeOf(volume, 0, i, spacing), placeOf(volume, 1, j, spacing),
                         placeOf(volume, 2, k, spacing));
        if (!volume.contains || volume.contains(x)) visit(x);
      }
    }
  }
}

bool isClear(const Vector3d& x, const Container& container, double spacing) {
  const double nearest = kClearance * spacing;
  if (container.enclosure) return container.enclosure->distance(x) >= nearest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = x[static_cast<Eigen::Index>(axis)];
    if (!(at >= nearest && at <= container.size[axis] - nearest)) return false;
  }
  return true;
}

void checkClear(const FluidVolume& volume, const Vector3d& x, const Container& container, double spacing) {
  if (container.enclosure) return checkInEnclosure(volume, x, *container.enclosure, spacing);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = x[static_cast<Eigen::Index>(axis)];
    if (at >= kClearance * spacing && at <= container.size[axis] - kClearance * spacing) continue;
    std::ostringstream problem;
    problem << "the " << volume.noun << " has a particle at " << kAxes[axis] << " = " << container.origin[axis] + at
            << " m; particles must start one spacing inside the container's faces, within ["
            << container.origin[axis] + spacing << ", " << container.origin[axis] + container.size[axis] - spacing
            << "] m";
    throw core::InputError("", volume.place, problem.str());
  }
}

void checkClear(const FluidVolume& volume, const Container& container, double spacing) {
  if (std::ranges::find(volume.counts, 0U) != volume.counts.end()) return;
  const std::array<Vector3d, 8> corners = cornersOf(volume, spacing);
  // Containers are convex.
  if (std::ranges::all_of(corners, [&](const Vector3d& x) { return isClear(x, container, spacing); })) return;
  if (!volume.contains) {
    for (const Vector3d& x : corners) checkClear(volume, x, container, spacing);
  }
  forEachPlace(volume, spacing, [&](const Vector3d& x) { checkClear(volume, x, container, spacing); });
}

bool holds(const FluidVolume& volume, const Vector3d& x, double spacing) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double step = (x[static_cast<Eigen::Index>(axis)] - volume.first[axis]) / spacing;
    if (step <= -0.5 || step >= volume.counts[axis] - 0.5) return false;
  }
  return !volume.contains || volume.contains(x);
}

}  // namespace sluice::sim
