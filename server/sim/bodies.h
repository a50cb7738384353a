#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <google/protobuf/repeated_ptr_field.h>

#include "cell_grid.h"
#include "container.h"
#include "discretisation.h"
#include "particles.h"
#include "sluice/solids/placed_body.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// Whether a body has to be looked at in every step: it moves, or the fluid rubs against it. See MovingBodies.
bool feltAsMoving(const v1::Body& body);

/// A set of bodies: bit k stands for the k-th that fluid flows around, of which there are at most 64.
using BodySet = std::uint64_t;

/// The scene's bodies that fluid flows around, where they start, in the coordinates of the container. Those that are
/// felt as moving take room at the start, and are left to MovingBodies from then on. A planar scene has none.
/// Immutable; all functions are thread-safe.
class Bodies {
 public:
  using List = google::protobuf::RepeatedPtrField<v1::Body>;

  /// A point of a body's surface that a boundary particle stands for.
  struct Sample {
    Float4 position;
    int layers;        ///< That its body's wall is thick.
    std::size_t body;  ///< Whose it is.
  };

  Bodies() = default;

  /// Throws core::InputError where a mesh cannot be read, with the body's field path.
  Bodies(const List& bodies, const Container& container, const Discretisation& discretisation, int layers);

  bool empty() const { return walls_.empty(); }
  std::size_t size() const { return walls_.size(); }

  /// About how many samples a body's whole surface has.
  double expectedSamples(std::size_t body) const;

  /// The samples of all bodies that stand, in order, without those that are out of reach of the container's inside.
  std::vector<Sample> samples() const;

  /// The point of the given bodies' surfaces that is closest to `x`; one that is not nearer than `reach` need not be
  /// found.
  solids::ClosestPoint closest(const Eigen::Vector3d& x, BodySet bodies, double reach) const;

  /// The first body that has a point inside, or nearer to its surface than `distance`.
  std::optional<std::size_t> bodyAt(const Eigen::Vector3d& x, double distance) const;

  /// The same of those that never move, whatever is felt of them.
  std::optional<std::size_t> fixedBodyAt(const Eigen::Vector3d& x, double distance) const;

  /// Whether one of those that stand has a point inside, or nearer to its surface than `distance`.
  bool anyStandsAt(const Eigen::Vector3d& x, double distance) const;

  /// Those that stand. Valid as long as this.
  std::vector<const solids::PlacedBody*> standing() const;

  /// The bodies that stand within reach of each cell: what a particle in it may touch or feel within a step.
  std::vector<BodySet> nearCells(const CellGeometry& geometry) const;

  /// "bodies[2]", as the scene counts.
  const std::string& pathOf(std::size_t body) const { return walls_[body].path; }
  /// "bodies[2] (pillar)".
  const std::string& nameOf(std::size_t body) const { return walls_[body].name; }

  double adhesion(std::size_t body) const { return walls_[body].adhesion; }  ///< N/m.
  double largestAdhesion() const;                                            ///< Of any, N/m.
  /// Whether fluid adheres to one that stands.
  bool anyStandingAdheres() const;

  /// What a person may not expect of them.
  const std::vector<std::string>& notices() const { return notices_; }

 private:
  struct Wall {
    solids::PlacedBody body;
    solids::SurfaceSampling sampling;
    std::string path;     ///< "bodies[2]".
    std::string name;     ///< "bodies[2] (pillar)".
    bool stands = true;   ///< Is not felt as moving.
    bool isFixed = true;  ///< Neither driven nor floating.
    double adhesion = 0;
  };

  /// The first body that `counts` and has a point inside, or nearer to its surface than `distance`.
  template <class Counts>
  std::optional<std::size_t> find(const Eigen::Vector3d& x, double distance, Counts&& counts) const;

  std::vector<Wall> walls_;
  std::vector<std::string> notices_;
  Eigen::AlignedBox3d within_;  ///< What a boundary particle may lie in to be felt.
  double reach_ = 0;            ///< Support and the longest move of a step, m.
};

}  // namespace sluice::sim
