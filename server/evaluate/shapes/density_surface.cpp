#include "shapes/density_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice::evaluate {

namespace {

/// H = 2.5 d: a lattice's surface is flat to a few hundredths of d, and a sheet one particle thick, whose f peaks at
/// 1.4 d/H, still reaches the level.
constexpr double kSupportSpacings = 2.5;
constexpr double kLevel = 0.5;
constexpr double kStepSpacings = 0.1;

/// Memory for cells, at most; a sparse cloud takes larger ones.
constexpr double kMaxCells = 1 << 24;

/// Cubic spline, Monaghan 1992, of compact support H: W = 8/(πH³)·w(r/H).
double kernel(double x) {
  if (x >= 1) return 0;
  if (x <= 0.5) return 6 * (x * x * x - x * x) + 1;
  const double t = 1 - x;
  return 2 * t * t * t;
}

double kernelSlope(double x) {
  if (x >= 1) return 0;
  if (x <= 0.5) return 6 * x * (3 * x - 2);
  const double t = 1 - x;
  return -6 * t * t;
}

/// Where a line enters and leaves a box; empty where it misses it.
std::optional<std::pair<double, double>> span(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& eye,
                                              const Eigen::Vector3d& direction) {
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (eye[axis] < box.min()[axis] || eye[axis] > box.max()[axis]) return std::nullopt;
      continue;
    }
    const double a = (box.min()[axis] - eye[axis]) / direction[axis];
    const double b = (box.max()[axis] - eye[axis]) / direction[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  if (near >= far) return std::nullopt;
  return std::pair(near, far);
}

}  // namespace

DensitySurface::DensitySurface(const std::vector<Eigen::Vector3f>& positions, double spacing)
    : spacing_(spacing), cellEdge_(kSupportSpacings * spacing) {
  for (const Eigen::Vector3f& p : positions) box_.extend(p.cast<double>());
  if (positions.empty()) box_.extend(Eigen::Vector3d::Zero());
  // The level set lies within the support of the outermost particles; one more keeps neighbours of cells inside.
  box_.min().array() -= cellEdge_;
  box_.max().array() += cellEdge_;
  const double wanted = (box_.sizes() / cellEdge_).array().ceil().prod();
  if (wanted > kMaxCells) cellEdge_ *= std::cbrt(wanted / kMaxCells);  // a search in larger cells is right, and slower
  const Eigen::Vector3d counts = (box_.sizes() / cellEdge_).array().ceil().max(1);
  for (int axis = 0; axis < 3; ++axis) cells_[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(counts[axis]);

  const auto count = static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]);
  starts_.assign(count + 1, 0);
  for (const Eigen::Vector3f& p : positions) ++starts_[cellIndex(cellOf(p.cast<double>())) + 1];
  for (std::size_t c = 0; c < count; ++c) starts_[c + 1] += starts_[c];
  particles_.resize(positions.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const Eigen::Vector3f& p : positions) particles_[next[cellIndex(cellOf(p.cast<double>()))]++] = p;

  near_.assign(count, 0);
  for (std::int64_t z = 0; z < cells_[2]; ++z) {
    for (std::int64_t y = 0; y < cells_[1]; ++y) {
      for (std::int64_t x = 0; x < cells_[0]; ++x) {
        const std::size_t c = cellIndex({x, y, z});
        if (starts_[c] == starts_[c + 1]) continue;
        for (std::int64_t k = std::max<std::int64_t>(z - 1, 0); k <= std::min(z + 1, cells_[2] - 1); ++k) {
          for (std::int64_t j = std::max<std::int64_t>(y - 1, 0); j <= std::min(y + 1, cells_[1] - 1); ++j) {
            for (std::int64_t i = std::max<std::int64_t>(x - 1, 0); i <= std::min(x + 1, cells_[0] - 1); ++i) {
              near_[cellIndex({i, j, k})] = 1;
            }
          }
        }
      }
    }
  }
}

std::size_t DensitySurface::cellIndex(const Cell& cell) const {
  return static_cast<std::size_t>(cell[0] + cells_[0] * (cell[1] + cells_[1] * cell[2]));
}

DensitySurface::Cell DensitySurface::cellOf(const Eigen::Vector3d& point) const {
  Cell cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const auto c = static_cast<std::int64_t>(std::floor((point[a] - box_.min()[a]) / cellEdge_));
    cell[axis] = std::clamp<std::int64_t>(c, 0, cells_[axis] - 1);
  }
  return cell;
}

bool DensitySurface::isNear(const Eigen::Vector3d& point) const { return near_[cellIndex(cellOf(point))] != 0; }

template <class Visit>
void DensitySurface::forEachNear(const Eigen::Vector3d& point, const Visit& visit) const {
  const Cell cell = cellOf(point);
  const std::int64_t firstX = std::max<std::int64_t>(cell[0] - 1, 0);
  const std::int64_t lastX = std::min(cell[0] + 1, cells_[0] - 1);
  for (std::int64_t z = std::max<std::int64_t>(cell[2] - 1, 0); z <= std::min(cell[2] + 1, cells_[2] - 1); ++z) {
    for (std::int64_t y = std::max<std::int64_t>(cell[1] - 1, 0); y <= std::min(cell[1] + 1, cells_[1] - 1); ++y) {
      // The cells of a row are one stretch of particles.
      const std::uint32_t first = starts_[cellIndex({firstX, y, z})];
      const std::uint32_t last = starts_[cellIndex({lastX, y, z}) + 1];
      for (std::uint32_t p = first; p < last; ++p) visit(Eigen::Vector3d(point - particles_[p].cast<double>()));
    }
  }
}

double DensitySurface::fraction(const Eigen::Vector3d& point) const {
  const double H = kSupportSpacings * spacing_;
  double sum = 0;
  forEachNear(point, [&](const Eigen::Vector3d& offset) {
    const double squared = offset.squaredNorm();
    if (squared < H * H) sum += kernel(std::sqrt(squared) / H);
  });
  const double ratio = spacing_ / H;
  return 8 / std::numbers::pi * ratio * ratio * ratio * sum;
}

Eigen::Vector3d DensitySurface::gradient(const Eigen::Vector3d& point) const {
  const double H = kSupportSpacings * spacing_;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  forEachNear(point, [&](const Eigen::Vector3d& offset) {
    const double r = offset.norm();
    if (r < H && r > 0) sum += offset / r * kernelSlope(r / H);
  });
  const double ratio = spacing_ / H;
  return 8 / std::numbers::pi * ratio * ratio * ratio / H * sum;
}

Eigen::Vector3d DensitySurface::outwardNormal(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d down = -gradient(point);
  const double length = down.norm();
  return length > 0 ? Eigen::Vector3d(down / length) : Eigen::Vector3d(Eigen::Vector3d::UnitY());
}

double DensitySurface::curvature(const Eigen::Vector3d& point) const {
  // −div n by central differences; a quarter of a spacing is well below the kernel's width.
  const double h = 0.25 * spacing_;
  double divergence = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
    divergence += (outwardNormal(point + step)[axis] - outwardNormal(point - step)[axis]) / (2 * h);
  }
  return -divergence;
}

std::optional<Hit> DensitySurface::trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const {
  const auto inBox = span(box_, eye, direction);
  if (!inBox) return std::nullopt;
  const double step = kStepSpacings * spacing_;
  double before = inBox->first;
  for (double t = inBox->first; t < inBox->second; t += step) {
    const Eigen::Vector3d point = eye + t * direction;
    if (isNear(point) && fraction(point) >= kLevel) {
      double low = before;
      double high = t;
      // 30 halvings of d/10 end below the resolution of the particles' single precision.
      for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (low + high);
        (fraction(eye + middle * direction) >= kLevel ? high : low) = middle;
      }
      const Eigen::Vector3d surface = eye + high * direction;
      return Hit{high, outwardNormal(surface), curvature(surface)};
    }
    before = t;
  }
  return std::nullopt;
}

}  // namespace sluice::evaluate
