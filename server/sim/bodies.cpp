#include "bodies.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "driven_motion.h"
#include "move_check.h"
#include "sluice/core/check.h"
#include "sluice/scene/convert.h"

namespace sluice::sim {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using solids::ClosestPoint;
using solids::PlacedBody;

Vector3d toVector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

Bodies::Bodies(const List& bodies, const Container& container, const Discretisation& discretisation, int layers)
    : within_(Vector3d::Constant(-discretisation.support),
              (toVector(container.size).array() + discretisation.support).matrix()),
      reach_(discretisation.support + kLargestMove * discretisation.spacing) {
  if (bodies.empty()) return;
  if (container.plane) {
    notices_.emplace_back("the scene is planar: its bodies are drawn, and hold no fluid");
    return;
  }
  SLUICE_CHECK(bodies.size() <= 64);
  for (int k = 0; k < bodies.size(); ++k) {
    if (!bodies[k].solid()) continue;
    const std::string path = "bodies[" + std::to_string(k) + "]";
    const std::string name = path + " (" + bodies[k].name() + ")";
    Isometry3d pose = scene::toPose(bodies[k]).cast<double>();
    pose.pretranslate(-toVector(container.origin));
    const PlacedBody body(solids::makeBodyShape(bodies[k], path), bodies[k].has_glass(), pose);
    if (bodies[k].has_mesh() && !body.shape().isClosed()) {
      notices_.push_back(name + " is a mesh with edges that do not have two faces: a thin wall without an inside");
    }
    walls_.push_back({body,
                      {discretisation.spacing, 0, body.isSolid() ? layers : 1},
                      path,
                      name,
                      !feltAsMoving(bodies[k]),
                      !moves(bodies[k]) && !bodies[k].has_floating(),
                      bodies[k].adhesion()});
  }
}

double Bodies::expectedSamples(std::size_t body) const {
  const Wall& wall = walls_[body];
  return wall.body.shape().area(wall.sampling) / (wall.sampling.spacing * wall.sampling.spacing);
}

std::vector<Bodies::Sample> Bodies::samples() const {
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    const Wall& wall = walls_[k];
    if (!wall.stands || !within_.intersects(wall.body.bounds())) continue;
    wall.body.shape().sample(wall.sampling, [&](const Vector3d& own) {
      const Vector3d x = wall.body.pose() * own;
      if (!within_.contains(x)) return;
      const Eigen::Vector3f place = x.cast<float>();
      samples.push_back({{place.x(), place.y(), place.z(), 0}, wall.sampling.layers, k});
    });
  }
  return samples;
}

double Bodies::largestAdhesion() const {
  double largest = 0;
  for (const Wall& wall : walls_) largest = std::max(largest, wall.adhesion);
  return largest;
}

bool Bodies::anyStandingAdheres() const {
  return std::ranges::any_of(walls_, [](const Wall& wall) { return wall.stands && wall.adhesion > 0; });
}

ClosestPoint Bodies::closest(const Vector3d& x, BodySet bodies, double reach) const {
  ClosestPoint best;
  for (; bodies != 0; bodies &= bodies - 1) {
    const PlacedBody& body = walls_[static_cast<std::size_t>(std::countr_zero(bodies))].body;
    const ClosestPoint found = body.closest(x, std::min(reach, best.distance));
    if (found.distance < best.distance) best = found;
  }
  return best;
}

template <class Counts>
std::optional<std::size_t> Bodies::find(const Vector3d& x, double distance, Counts&& counts) const {
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    if (counts(walls_[k]) && walls_[k].body.isNearer(x, distance)) return k;
  }
  return std::nullopt;
}

std::optional<std::size_t> Bodies::bodyAt(const Vector3d& x, double distance) const {
  return find(x, distance, [](const Wall&) { return true; });
}

std::optional<std::size_t> Bodies::fixedBodyAt(const Vector3d& x, double distance) const {
  return find(x, distance, [](const Wall& wall) { return wall.isFixed; });
}

bool Bodies::anyStandsAt(const Vector3d& x, double distance) const {
  return find(x, distance, [](const Wall& wall) { return wall.stands; }).has_value();
}

std::vector<const PlacedBody*> Bodies::standing() const {
  std::vector<const PlacedBody*> standing;
  for (const Wall& wall : walls_) {
    if (wall.stands) standing.push_back(&wall.body);
  }
  return standing;
}

std::vector<BodySet> Bodies::nearCells(const CellGeometry& geometry) const {
  if (empty()) return {};
  std::vector<BodySet> near(geometry.count(), 0);
  const double edge = 1 / static_cast<double>(geometry.inverseEdge);
  const double reach = reach_ + 0.5 * std::sqrt(3.0) * edge;
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    if (!walls_[k].stands) continue;
    const PlacedBody& body = walls_[k].body;
    std::array<std::uint32_t, 3> low{};
    std::array<std::uint32_t, 3> high{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      low[a] = geometry.coordinate(static_cast<float>(body.bounds().min()[axis] - reach_ - edge), axis);
      high[a] = geometry.coordinate(static_cast<float>(body.bounds().max()[axis] + reach_ + edge), axis);
    }
    for (std::uint32_t z = low[2]; z <= high[2]; ++z) {
      for (std::uint32_t y = low[1]; y <= high[1]; ++y) {
        for (std::uint32_t x = low[0]; x <= high[0]; ++x) {
          const Vector3d middle = edge * Vector3d(x + 0.5, y + 0.5, z + 0.5);
          if (body.closest(middle, reach).distance > reach) continue;
          near[x + std::size_t{geometry.cells[0]} * (y + std::size_t{geometry.cells[1]} * z)] |= BodySet{1} << k;
        }
      }
    }
  }
  return near;
}

}  // namespace sluice::sim
