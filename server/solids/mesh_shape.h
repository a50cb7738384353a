#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sluice/particleio/mesh_file.h"
#include "sluice/solids/body_shape.h"

namespace sluice::solids {

/// A surface of triangles. It is closed where every edge belongs to two of them; which way they face does not matter.
class MeshShape : public BodyShape {
 public:
  /// `scale` m per unit of the mesh.
  MeshShape(const particleio::TriangleMesh& mesh, double scale);

  Eigen::AlignedBox3d bounds() const override { return bounds_; }
  bool isClosed() const override { return closed_; }
  bool contains(const Eigen::Vector3d& x) const override;
  ClosestPoint closest(const Eigen::Vector3d& x, double reach) const override;
  double area(const SurfaceSampling& sampling) const override;
  std::vector<std::array<Eigen::Vector3d, 3>> triangles() const override { return triangles_; }
  void sample(const SurfaceSampling& sampling, const AddPoint& add) const override;

 private:
  using Triangle = std::array<Eigen::Vector3d, 3>;

  /// A box around the triangles order_[first, last). Its halves are the next node and `right`; 0 where it is a leaf.
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    std::uint32_t right = 0;
  };

  void addNode(std::uint32_t first, std::uint32_t last);
  void search(std::size_t node, const Eigen::Vector3d& x, ClosestPoint& best) const;
  void sortIntoColumns();
  std::size_t columnOf(double position, int axis) const;

  std::vector<Triangle> triangles_;
  Eigen::AlignedBox3d bounds_;
  bool closed_ = false;

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;

  /// The triangles above and below each square of a lattice over x and z.
  std::size_t columns_ = 1;
  std::vector<std::vector<std::uint32_t>> standing_;
};

}  // namespace sluice::solids
