#include "nearest_neighbours.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <Eigen/Geometry>

namespace sluice::sources {

namespace {

using Eigen::Vector3f;

/// A k-d tree in an array of its own points: the middle of every range splits it, the halves are its subtrees
/// [Friedman, Bentley & Finkel 1977]. Unlike a grid it takes points of any spread: two far clusters, a stray drop.
class KdTree {
 public:
  explicit KdTree(std::vector<Vector3f> points) : points_(std::move(points)), axes_(points_.size()) {
    build(0, points_.size());
  }

  std::span<const Vector3f> points() const { return points_; }

  /// Squared distance to the nearest point other than the one at `index`.
  double nearestSquared(std::size_t index) const {
    double best = std::numeric_limits<double>::infinity();
    search(0, points_.size(), index, best);
    return best;
  }

 private:
  void build(std::size_t begin, std::size_t end) {
    if (end - begin < 2) return;
    Eigen::AlignedBox3f bounds;
    for (std::size_t i = begin; i < end; ++i) bounds.extend(points_[i]);
    int axis = 0;
    bounds.sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](const Vector3f& a, const Vector3f& b) { return a[axis] < b[axis]; });
    axes_[middle] = static_cast<std::uint8_t>(axis);
    build(begin, middle);
    build(middle + 1, end);
  }

  void search(std::size_t begin, std::size_t end, std::size_t index, double& best) const {
    if (begin == end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const Vector3f& query = points_[index];
    if (middle != index) {
      best = std::min(best, (points_[middle].cast<double>() - query.cast<double>()).squaredNorm());
    }
    if (end - begin == 1) return;
    const int axis = axes_[middle];
    const double offset = static_cast<double>(query[axis]) - static_cast<double>(points_[middle][axis]);
    // Ties may lie on either side of the split: at offset 0 both halves are searched.
    const bool leftFirst = offset < 0;
    const auto searchLeft = [&] { search(begin, middle, index, best); };
    const auto searchRight = [&] { search(middle + 1, end, index, best); };
    leftFirst ? searchLeft() : searchRight();
    if (offset * offset <= best) leftFirst ? searchRight() : searchLeft();
  }

  std::vector<Vector3f> points_;
  std::vector<std::uint8_t> axes_;
};

}  // namespace

double medianNearestNeighbourDistance(std::vector<Vector3f> points, std::size_t samples) {
  const auto before = [](const Vector3f& a, const Vector3f& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 2) return 0;

  const KdTree tree(std::move(points));
  const std::size_t count = tree.points().size();
  const std::size_t measured = std::clamp<std::size_t>(samples, 1, count);
  std::vector<double> squared(measured);
  for (std::size_t i = 0; i < measured; ++i) squared[i] = tree.nearestSquared(i * count / measured);
  const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(measured / 2);
  std::nth_element(squared.begin(), middle, squared.end());
  return std::sqrt(*middle);
}

}  // namespace sluice::sources
