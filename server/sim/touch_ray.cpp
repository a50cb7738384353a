#include "touch_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice::sim {

namespace {

using Eigen::Vector3d;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Half the diagonal of a cubic cell, in its edges: √3/2, rounded up.
constexpr double kBallRadius = 0.8661;

struct Nearest {
  double distance = kNever;
  Nearest& operator+=(const Nearest& other) {
    distance = std::min(distance, other.distance);
    return *this;
  }
};

/// Cuts off what lies behind a plane whose normal looks to the inside.
void clip(Stretch& stretch, const TouchRay& ray, const Vector3d& normal, double offset) {
  const double height = normal.dot(ray.origin) - offset;
  const double slope = normal.dot(ray.direction);
  if (slope > 0) {
    stretch.first = std::max(stretch.first, -height / slope);
  } else if (slope < 0) {
    stretch.last = std::min(stretch.last, -height / slope);
  } else if (height < 0) {
    stretch.last = -kNever;
  }
}

/// Cuts off what lies outside of a sphere or an upright cylinder.
void clip(Stretch& stretch, const TouchRay& ray, const solids::Enclosure::Round& round) {
  Vector3d from = ray.origin - round.centre;
  Vector3d along = ray.direction;
  if (round.isUpright) from.y() = along.y() = 0;
  // |from + t along|² = R².
  const double a = along.squaredNorm();
  const double b = from.dot(along);
  const double c = from.squaredNorm() - round.radius * round.radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0 || (a == 0 && c > 0)) {
    stretch.last = -kNever;
  } else if (a > 0) {
    stretch.first = std::max(stretch.first, (-b - std::sqrt(discriminant)) / a);
    stretch.last = std::min(stretch.last, (-b + std::sqrt(discriminant)) / a);
  }
}

/// How far the nearest of the bodies is; 0 within a solid one. One that is not nearer than `reach` is not looked for.
double distanceTo(std::span<const solids::PlacedBody* const> bodies, const Vector3d& x, double reach) {
  double distance = kNever;
  for (const solids::PlacedBody* body : bodies) {
    if (body->contains(x)) return 0;
    distance = std::min(distance, body->closest(x, std::min(reach, distance)).distance);
  }
  return distance;
}

}  // namespace

std::optional<Stretch> insideContainer(const TouchRay& ray, const Container& container) {
  Stretch stretch{0, kNever};
  if (container.enclosure) {
    for (const auto& plane : container.enclosure->planes()) clip(stretch, ray, plane.normal, plane.offset);
    if (container.enclosure->round()) clip(stretch, ray, *container.enclosure->round());
  } else {
    for (std::size_t axis = 0; axis < container.walledAxes(); ++axis) {
      const Vector3d unit = Vector3d::Unit(static_cast<Eigen::Index>(axis));
      clip(stretch, ray, unit, 0);
      clip(stretch, ray, -unit, -container.size[axis]);
    }
  }
  if (stretch.first >= stretch.last || stretch.last == kNever) return std::nullopt;
  return stretch;
}

std::optional<double> firstParticle(const TouchRay& ray, const std::vector<Float4>& positions, double spacing,
                                    const Team& team) {
  const double square = kBallRadius * kBallRadius * spacing * spacing;
  const auto nearest = team.sumOverChunks<Nearest>(positions.size(), [&](const Chunk& chunk) {
    Nearest part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Vector3d from = Vector3d(positions[i].x, positions[i].y, positions[i].z) - ray.origin;
      const double along = from.dot(ray.direction);
      const double halfChordSquare = square - (from - along * ray.direction).squaredNorm();
      if (halfChordSquare <= 0) continue;
      const double halfChord = std::sqrt(halfChordSquare);
      if (along + halfChord < 0) continue;
      part.distance = std::min(part.distance, std::max(along - halfChord, 0.0));
    }
    return part;
  });
  if (nearest.distance == kNever) return std::nullopt;
  return nearest.distance;
}

std::optional<double> firstBody(const TouchRay& ray, const Stretch& stretch,
                                std::span<const solids::PlacedBody* const> bodies, double spacing) {
  const double touching = 0.01 * spacing;
  for (double at = stretch.first; at < stretch.last;) {
    const double distance = distanceTo(bodies, ray.at(at), stretch.last - at);
    if (distance <= touching) return at;
    at += distance;
  }
  return std::nullopt;
}

}  // namespace sluice::sim
