#include "mesh_shape.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

namespace sluice::solids {

namespace {

using Eigen::Vector3d;
using Index = std::uint32_t;

/// Triangles that are looked at one by one rather than sorted into boxes.
constexpr Index kLeaf = 4;

/// Closest that samples come to one another, in spacings. Packed as densely as candidates in rows allow, this leaves
/// about one sample to each spacing squared.
constexpr double kClosestSamples = 0.875;

/// Candidates along a spacing.
constexpr double kCandidates = 5;

Vector3d closestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& x) {
  const Vector3d ab = b - a;
  const double square = ab.squaredNorm();
  const double t = square > 0 ? std::clamp((x - a).dot(ab) / square, 0.0, 1.0) : 0;
  return a + t * ab;
}

Vector3d closestOnTriangle(const std::array<Vector3d, 3>& t, const Vector3d& x) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  bool above = true;  // Or below: within the prism over the triangle.
  Vector3d best = t[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& a = t[k];
    const Vector3d& b = t[(k + 1) % 3];
    above = above && normal.dot((b - a).cross(x - a)) >= 0;
    const Vector3d onEdge = closestOnSegment(a, b, x);
    if ((onEdge - x).squaredNorm() < (best - x).squaredNorm()) best = onEdge;
  }
  return above && normal.squaredNorm() > 0 ? Vector3d(x - normal * (normal.dot(x - t[0]) / normal.squaredNorm()))
                                           : best;
}

/// Numbers of the vertices, the same for those in one place.
std::vector<Index> weld(const std::vector<Eigen::Vector3f>& positions) {
  std::map<std::array<float, 3>, Index> places;
  std::vector<Index> numbers;
  for (const Eigen::Vector3f& p : positions) {
    numbers.push_back(places.try_emplace({p.x(), p.y(), p.z()}, static_cast<Index>(places.size())).first->second);
  }
  return numbers;
}

/// How often each edge occurs, whichever way it runs.
class EdgeCount {
 public:
  void add(Index a, Index b) { ++faces_[{std::min(a, b), std::max(a, b)}]; }
  bool allTwice() const {
    return !faces_.empty() && std::ranges::all_of(faces_, [](const auto& edge) { return edge.second == 2; });
  }

 private:
  std::map<std::pair<Index, Index>, int> faces_;
};

/// Whether the edge crosses the half-line from (x, z) towards greater x. Both faces of an edge get the same answer, so
/// that a column of points never slips between them.
bool crosses(Vector3d a, Vector3d b, double x, double z) {
  if ((a.z() > z) == (b.z() > z)) return false;
  if (a.z() > b.z()) std::swap(a, b);
  return x < a.x() + (b.x() - a.x()) * ((z - a.z()) / (b.z() - a.z()));
}

/// Points no two of which are closer than a distance.
class SpacedPoints {
 public:
  explicit SpacedPoints(double distance) : distance_(distance) {}

  /// Whether the point was far enough from all others, and has been taken.
  bool add(const Vector3d& x) {
    const Cell middle = cellOf(x);
    for (std::int64_t k = -1; k <= 1; ++k) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        for (std::int64_t i = -1; i <= 1; ++i) {
          const auto found = cells_.find({middle[0] + i, middle[1] + j, middle[2] + k});
          if (found == cells_.end()) continue;
          for (const Vector3d& other : found->second) {
            if ((other - x).squaredNorm() < distance_ * distance_) return false;
          }
        }
      }
    }
    cells_[middle].push_back(x);
    return true;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    // The primes of Teschner et al. 2003.
    std::size_t operator()(const Cell& c) const {
      return (static_cast<std::size_t>(c[0]) * 73856093U) ^ (static_cast<std::size_t>(c[1]) * 19349663U) ^
             (static_cast<std::size_t>(c[2]) * 83492791U);
    }
  };

  Cell cellOf(const Vector3d& x) const {
    const auto number = [&](double position) { return static_cast<std::int64_t>(std::floor(position / distance_)); };
    return {number(x.x()), number(x.y()), number(x.z())};
  }

  double distance_;
  std::unordered_map<Cell, std::vector<Vector3d>, Hash> cells_;
};

/// Calls `visit` with points of a triangle in rows along its longest edge, `step` apart or a little less.
template <class Visit>
void forEachCandidate(const std::array<Vector3d, 3>& triangle, double step, Visit&& visit) {
  std::size_t longest = 0;
  const auto length = [&](std::size_t k) { return (triangle[(k + 1) % 3] - triangle[k]).norm(); };
  for (std::size_t k = 1; k < 3; ++k) {
    if (length(k) > length(longest)) longest = k;
  }
  const Vector3d& a = triangle[longest];
  const Vector3d& b = triangle[(longest + 1) % 3];
  const Vector3d& c = triangle[(longest + 2) % 3];
  const double base = (b - a).norm();
  const double height = (b - a).cross(c - a).norm() / base;
  const auto rows = static_cast<std::int64_t>(std::ceil(height / step));
  for (std::int64_t row = 0; row <= rows; ++row) {
    const double v = rows == 0 ? 0 : static_cast<double>(row) / static_cast<double>(rows);
    const auto places = static_cast<std::int64_t>(std::ceil(base * (1 - v) / step));
    for (std::int64_t place = 0; place <= places; ++place) {
      const double u = places == 0 ? 0 : static_cast<double>(place) / static_cast<double>(places);
      visit(Vector3d((1 - v) * ((1 - u) * a + u * b) + v * c));
    }
  }
}

}  // namespace

MeshShape::MeshShape(const particleio::TriangleMesh& mesh, double scale) {
  const std::vector<Index> welded = weld(mesh.positions);
  EdgeCount edges;
  for (const auto& corners : mesh.triangles) {
    const std::array<Index, 3> number{welded[corners[0]], welded[corners[1]], welded[corners[2]]};
    // A triangle that is only an edge closes nothing and holds nothing.
    if (number[0] == number[1] || number[1] == number[2] || number[2] == number[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) edges.add(number[k], number[(k + 1) % 3]);
    Triangle& triangle = triangles_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = scale * mesh.positions[corners[k]].cast<double>();
      bounds_.extend(triangle[k]);
    }
  }
  closed_ = edges.allTwice();
  if (triangles_.empty()) bounds_ = Eigen::AlignedBox3d(Vector3d::Zero().eval());
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  if (!order_.empty()) addNode(0, static_cast<Index>(order_.size()));
  sortIntoColumns();
}

void MeshShape::addNode(Index first, Index last) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({{}, first, last, 0});
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d middles;
  const auto middleOf = [&](Index t) { return Vector3d((triangles_[t][0] + triangles_[t][1] + triangles_[t][2]) / 3); };
  for (Index k = first; k < last; ++k) {
    for (const Vector3d& corner : triangles_[order_[k]]) box.extend(corner);
    middles.extend(middleOf(order_[k]));
  }
  nodes_[node].box = box;
  if (last - first <= kLeaf) return;
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const Index half = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](Index a, Index b) { return middleOf(a)[axis] < middleOf(b)[axis]; });
  addNode(first, half);
  nodes_[node].right = static_cast<Index>(nodes_.size());
  addNode(half, last);
}

std::size_t MeshShape::columnOf(double position, int axis) const {
  const double share = (position - bounds_.min()[axis]) / std::max(bounds_.sizes()[axis], 1e-30);
  return static_cast<std::size_t>(
      std::clamp(share * static_cast<double>(columns_), 0.0, static_cast<double>(columns_ - 1)));
}

void MeshShape::sortIntoColumns() {
  if (!closed_) return;
  columns_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(triangles_.size())), 1, 512);
  standing_.resize(columns_ * columns_);
  for (Index t = 0; t < triangles_.size(); ++t) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& corner : triangles_[t]) box.extend(corner);
    for (std::size_t k = columnOf(box.min().z(), 2); k <= columnOf(box.max().z(), 2); ++k) {
      for (std::size_t i = columnOf(box.min().x(), 0); i <= columnOf(box.max().x(), 0); ++i) {
        standing_[i + columns_ * k].push_back(t);
      }
    }
  }
}

bool MeshShape::contains(const Vector3d& x) const {
  if (!closed_ || !bounds_.contains(x)) return false;
  bool inside = false;
  for (const Index t : standing_[columnOf(x.x(), 0) + columns_ * columnOf(x.z(), 2)]) {
    const Triangle& triangle = triangles_[t];
    bool over = false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (crosses(triangle[k], triangle[(k + 1) % 3], x.x(), x.z())) over = !over;
    }
    if (!over) continue;
    const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    if (normal.y() == 0) continue;
    const Vector3d fromCorner = x - triangle[0];
    const double height = -(normal.x() * fromCorner.x() + normal.z() * fromCorner.z()) / normal.y();
    if (height > fromCorner.y()) inside = !inside;
  }
  return inside;
}

ClosestPoint MeshShape::closest(const Vector3d& x, double reach) const {
  ClosestPoint best{Vector3d::Zero(), reach};
  if (!nodes_.empty()) search(0, x, best);
  return best.distance < reach ? best : ClosestPoint{};
}

void MeshShape::search(std::size_t node, const Vector3d& x, ClosestPoint& best) const {
  const Node& here = nodes_[node];
  if (here.box.squaredExteriorDistance(x) >= best.distance * best.distance) return;
  if (here.right == 0) {
    for (Index k = here.first; k < here.last; ++k) {
      const Vector3d point = closestOnTriangle(triangles_[order_[k]], x);
      const double distance = (point - x).norm();
      if (distance < best.distance) best = {point, distance};
    }
    return;
  }
  std::size_t nearer = node + 1;
  std::size_t farther = here.right;
  if (nodes_[farther].box.squaredExteriorDistance(x) < nodes_[nearer].box.squaredExteriorDistance(x)) {
    std::swap(nearer, farther);
  }
  search(nearer, x, best);
  search(farther, x, best);
}

double MeshShape::area(const SurfaceSampling& sampling) const {
  double total = 0;
  for (const Triangle& t : triangles_) total += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  return total * (closed_ ? sampling.layers : 1);
}

/// Candidates in rows over every triangle; each is taken that is far enough from all before it.
void MeshShape::sample(const SurfaceSampling& sampling, const AddPoint& add) const {
  const double d = sampling.spacing;
  SpacedPoints taken(kClosestSamples * d);
  const int layers = closed_ ? std::max(1, sampling.layers) : 1;
  for (int layer = 0; layer < layers; ++layer) {
    const double depth = (closed_ ? sampling.inset : 0) + layer * d;
    for (const Triangle& triangle : triangles_) {
      const Vector3d inset = depth * (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized();
      forEachCandidate(triangle, d / kCandidates, [&](const Vector3d& surface) {
        if (depth == 0) {
          if (taken.add(surface)) add(surface);
          return;
        }
        // Triangles may face either way; what is behind a thin place or a sharp edge is nearer to the far side.
        for (const Vector3d& point : {Vector3d(surface - inset), Vector3d(surface + inset)}) {
          if (contains(point) && closest(point, depth).distance >= 0.9 * depth && taken.add(point)) add(point);
        }
      });
    }
  }
}

}  // namespace sluice::solids
