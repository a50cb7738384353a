#include "metrics/surface_geometry.h"

#include <cmath>
#include <limits>

#include "sluice/core/check.h"

namespace sluice::evaluate {

namespace {

/// First and second difference along one axis, per pixel; the second only where both neighbours are on the surface.
struct Differences {
  double first = 0;
  double second = std::numeric_limits<double>::quiet_NaN();
};

class Reader {
 public:
  Reader(const std::vector<float>& q, const Sight& sight, double edge) : q_(q), sight_(sight), edge_(edge) {}

  double at(int x, int y) const {
    if (x < 0 || y < 0 || x >= sight_.size.width || y >= sight_.size.height) return 0;
    return q_[sight_.index(x, y)];
  }

  /// Eye depths z = 1/q that differ by at most `edge`, without a division.
  bool onOneSurface(double a, double b) const { return a > 0 && b > 0 && std::abs(a - b) <= edge_ * a * b; }

  Differences along(double before, double q, double after) const {
    const bool hasBefore = onOneSurface(q, before);
    const bool hasAfter = onOneSurface(q, after);
    if (hasBefore && hasAfter) return {0.5 * (after - before), after - 2 * q + before};
    if (hasBefore) return {.first = q - before};
    if (hasAfter) return {.first = after - q};
    return {};
  }

  /// Mixed second difference; NaN unless all four corners are on the surface.
  double mixed(int x, int y) const {
    const double q = at(x, y);
    const double upLeft = at(x - 1, y - 1);
    const double upRight = at(x + 1, y - 1);
    const double downLeft = at(x - 1, y + 1);
    const double downRight = at(x + 1, y + 1);
    for (const double corner : {upLeft, upRight, downLeft, downRight}) {
      if (!onOneSurface(q, corner)) return std::numeric_limits<double>::quiet_NaN();
    }
    return 0.25 * (downRight - downLeft - upRight + upLeft);
  }

 private:
  const std::vector<float>& q_;
  const Sight& sight_;
  double edge_;
};

}  // namespace

SurfaceGeometry geometryOf(const std::vector<float>& q, const Sight& sight, double edge) {
  SLUICE_CHECK_EQ(q.size(), sight.pixels());
  SurfaceGeometry geometry;
  geometry.normals.assign(q.size(), Eigen::Vector3f::Zero());
  geometry.curvatures.assign(q.size(), std::numeric_limits<float>::quiet_NaN());
  const Reader reader(q, sight, edge);
  const double C = sight.pixelSlope;
  for (int y = 0; y < sight.size.height; ++y) {
    for (int x = 0; x < sight.size.width; ++x) {
      const double here = reader.at(x, y);
      if (!(here > 0)) continue;
      const Differences alongX = reader.along(reader.at(x - 1, y), here, reader.at(x + 1, y));
      const Differences alongY = reader.along(reader.at(x, y - 1), here, reader.at(x, y + 1));
      const Eigen::Vector2d W = sight.slope(x, y);
      const Eigen::Vector2d gradient = Eigen::Vector2d(alongX.first, alongY.first) / C;
      const Eigen::Vector3d N(gradient.x(), gradient.y(), here - W.dot(gradient));
      const double squared = N.squaredNorm();
      const std::size_t i = sight.index(x, y);
      geometry.normals[i] = (-N / std::sqrt(squared)).cast<float>();

      const double xx = alongX.second / (C * C);
      const double yy = alongY.second / (C * C);
      const double xy = reader.mixed(x, y) / (C * C);
      const Eigen::Vector2d b = gradient - W * N.z();
      const double flat = (1 + W.x() * W.x()) * xx + 2 * W.x() * W.y() * xy + (1 + W.y() * W.y()) * yy;
      const double steep = (b.x() * b.x() * xx + 2 * b.x() * b.y() * xy + b.y() * b.y() * yy) / squared;
      geometry.curvatures[i] = static_cast<float>(here / std::sqrt(squared) * (flat - steep));
    }
  }
  return geometry;
}

}  // namespace sluice::evaluate
