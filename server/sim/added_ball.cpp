#include "added_ball.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fluid_volumes.h"

namespace sluice::sim {

namespace {

using Eigen::Vector3d;

/// How near a place may be to another particle, in spacings: settled fluid, whose particles are that close now and
/// then, is not burst by it.
constexpr double kClosest = 0.9;

/// Positions of particles, by chunks in order.
struct Near {
  std::vector<Vector3d> all;
  Near& operator+=(const Near& other) {
    all.insert(all.end(), other.all.begin(), other.all.end());
    return *this;
  }
};

/// The cubic lattice around a ball: points (i, j, k) of -reach … reach each, those of a plane alone where it is flat.
class Lattice {
 public:
  Lattice(const AddedBall& ball, bool isPlanar)
      : ball_(ball),
        reach_(static_cast<int>(std::floor(ball.radius / ball.spacing))),
        depth_(isPlanar ? 0 : reach_),
        taken_(static_cast<std::size_t>(edge() * edge() * (2 * depth_ + 1)), 0) {}

  Vector3d at(int i, int j, int k) const { return ball_.centre + ball_.spacing * Vector3d(i, j, k); }

  char& taken(int i, int j, int k) {
    return taken_[static_cast<std::size_t>((i + reach_) + edge() * ((j + reach_) + edge() * (k + depth_)))];
  }

  /// Calls `visit(i, j, k)` for the points of the ball, x fastest.
  template <class Visit>
  void forEachPoint(const Visit& visit) const {
    const double radii = ball_.radius / ball_.spacing;
    for (int k = -depth_; k <= depth_; ++k) {
      for (int j = -reach_; j <= reach_; ++j) {
        for (int i = -reach_; i <= reach_; ++i) {
          if (static_cast<double>(i * i + j * j + k * k) <= radii * radii) visit(i, j, k);
        }
      }
    }
  }

  /// Takes the points that are too near to a particle.
  void take(const Vector3d& particle) {
    const double closest = kClosest * ball_.spacing;
    const Vector3d place = (particle - ball_.centre) / ball_.spacing;
    const auto first = [](double x, int reach) { return std::max(static_cast<int>(std::floor(x)), -reach); };
    const auto last = [](double x, int reach) { return std::min(static_cast<int>(std::ceil(x)), reach); };
    for (int k = first(place.z(), depth_); k <= last(place.z(), depth_); ++k) {
      for (int j = first(place.y(), reach_); j <= last(place.y(), reach_); ++j) {
        for (int i = first(place.x(), reach_); i <= last(place.x(), reach_); ++i) {
          if ((at(i, j, k) - particle).squaredNorm() < closest * closest) taken(i, j, k) = 1;
        }
      }
    }
  }

 private:
  int edge() const { return 2 * reach_ + 1; }

  AddedBall ball_;
  int reach_;
  int depth_;
  std::vector<char> taken_;
};

bool insideContainer(const Vector3d& x, const Container& container, double clearance) {
  if (container.enclosure) return container.enclosure->distance(x) >= clearance;
  for (std::size_t axis = 0; axis < container.walledAxes(); ++axis) {
    const double at = x[static_cast<Eigen::Index>(axis)];
    if (at < clearance || at > container.size[axis] - clearance) return false;
  }
  return true;
}

bool nearBody(const Vector3d& x, const solids::PlacedBody& body, double reach) {
  if (body.bounds().squaredExteriorDistance(x) >= reach * reach) return false;
  return body.contains(x) || body.closest(x, reach).distance < reach;
}

Near particlesNear(const AddedBall& ball, const std::vector<Float4>& positions, const Team& team) {
  const double reach = ball.radius + ball.spacing;
  return team.sumOverChunks<Near>(positions.size(), [&](const Chunk& chunk) {
    Near part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Vector3d x(positions[i].x, positions[i].y, positions[i].z);
      if ((x - ball.centre).squaredNorm() < reach * reach) part.all.push_back(x);
    }
    return part;
  });
}

}  // namespace

BallPlaces placesOf(const AddedBall& ball, const Surroundings& around, const Team& team) {
  Lattice lattice(ball, around.container.plane.has_value());
  for (const Vector3d& particle : particlesNear(ball, around.particles, team).all) lattice.take(particle);
  BallPlaces places;
  lattice.forEachPoint([&](int i, int j, int k) {
    const Vector3d x = lattice.at(i, j, k);
    const bool nearSolid = !insideContainer(x, around.container, kClearance * ball.spacing) ||
                           std::ranges::any_of(around.bodies, [&](const solids::PlacedBody* body) {
                             return nearBody(x, *body, kStartingDistance * ball.spacing);
                           });
    if (nearSolid) {
      ++places.bySolids;
    } else if (lattice.taken(i, j, k) != 0) {
      ++places.byFluid;
    } else {
      const Eigen::Vector3f place = x.cast<float>();
      places.free.push_back({place.x(), place.y(), place.z(), 0});
    }
  });
  return places;
}

}  // namespace sluice::sim
