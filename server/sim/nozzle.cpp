#include "nozzle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "sluice/core/input_error.h"
#include "sluice/scene/convert.h"

namespace sluice::sim {

namespace {

using Eigen::Vector3d;

/// Particles that have left after `layers` of them.
std::uint64_t givenAfter(std::uint64_t layers, double perLayer) {
  return static_cast<std::uint64_t>(std::floor(static_cast<double>(layers) * perLayer + 0.5));
}

void checkPlanar(const v1::Emitter& settings, const std::string& path, const Container& container) {
  if (!container.plane) return;
  if (std::abs(settings.position().z() - (container.origin[2] + *container.plane)) > kPlaneTolerance) {
    std::ostringstream problem;
    problem << "the scene is planar: z must be that of its first volume, " << container.origin[2] + *container.plane
            << " m";
    throw core::InputError("", path + ".position.z", problem.str());
  }
  if (settings.direction().z() != 0) {
    throw core::InputError("", path + ".direction.z", "must be 0: the scene is planar");
  }
}

}  // namespace

Nozzle::Nozzle(const v1::Emitter& settings, int fluid, const std::string& path, const Container& container,
               double spacing)
    : path_(path),
      fluid_(fluid),
      mouth_(scene::toVector(settings.position()) - Vector3d::Map(container.origin.data())),
      direction_(scene::toVector(settings.direction()).normalized()),
      radius_(settings.radius()),
      speed_(settings.speed()),
      start_(settings.start_seconds()),
      end_(settings.end_seconds()),
      most_(settings.max_particles()),
      spacing_(spacing) {
  checkPlanar(settings, path, container);
  const double radii = radius_ / spacing;
  perLayer_ = container.plane ? 2 * radii : std::numbers::pi * radii * radii;
  if (!(perLayer_ >= 1)) {
    std::ostringstream problem;
    problem << radius_ << " m is too little for a particle to come out: must be at least "
            << spacing * (container.plane ? 0.5 : std::sqrt(std::numbers::inv_pi))
            << " m, or the particle_spacing less";
    throw core::InputError("", path + ".radius", problem.str());
  }
  // Drawn out of this many particles at a time, a jet is a scene's whole fluid.
  constexpr double kLargestLayer = 1e6;
  if (perLayer_ > kLargestLayer) {
    std::ostringstream problem;
    problem << "a layer would have " << perLayer_ << " particles; allowed are at most " << kLargestLayer;
    throw core::InputError("", path + ".radius", problem.str());
  }
  if (end_ < start_) {
    std::ostringstream problem;
    problem << end_ << " s is before start_seconds, " << start_ << " s";
    throw core::InputError("", path + ".end_seconds", problem.str());
  }
  if (container.plane) {
    packSlit();
  } else {
    packDisc();
  }
}

std::uint32_t Nozzle::layerSize(std::uint64_t layer) const {
  return static_cast<std::uint32_t>(givenAfter(layer + 1, perLayer_) - givenAfter(layer, perLayer_));
}

void Nozzle::packDisc() {
  struct Point {
    double square, angle;
    Vector3d offset;
  };
  const Vector3d across = direction_.unitOrthogonal();
  const Vector3d along = direction_.cross(across);
  // Edge of a hexagonal packing of one point to each spacing squared.
  const double edge = spacing_ * std::sqrt(2 / std::numbers::sqrt3);
  const auto reach = static_cast<int>(std::ceil(1.2 * radius_ / edge)) + 2;
  std::vector<Point> points;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      // Squared in units of the edge, in whole numbers: points of one ring are exactly as far out.
      const double square = static_cast<double>(i) * i + static_cast<double>(i) * j + static_cast<double>(j) * j;
      const double x = edge * (i + 0.5 * j);
      const double y = edge * (0.5 * std::numbers::sqrt3 * j);
      points.push_back({square, std::atan2(y, x), x * across + y * along});
    }
  }
  std::ranges::sort(points, [](const Point& a, const Point& b) {
    return a.square != b.square ? a.square < b.square : a.angle < b.angle;
  });
  points.resize(static_cast<std::size_t>(std::floor(perLayer_)) + 1);
  for (const Point& point : points) offsets_.push_back(point.offset);
}

void Nozzle::packSlit() {
  const Vector3d along(-direction_.y(), direction_.x(), 0);
  const auto count = static_cast<int>(std::floor(perLayer_)) + 1;
  for (int k = 0; k < count; ++k) {
    // 0, 1, -1, 2, -2, …
    const int place = (k % 2 == 1 ? 1 : -1) * ((k + 1) / 2);
    offsets_.emplace_back(place * spacing_ * along);
  }
}

}  // namespace sluice::sim
