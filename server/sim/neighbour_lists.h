#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "boundary.h"
#include "cell_grid.h"
#include "pair_loops.h"
#include "particles.h"
#include "team.h"
#include "wall_contact.h"

namespace sluice::sim {

/// The pairs of all particles, found once per step and used by every loop of the next, with the sums over them.
/// Storage is kept from step to step; it belongs to chunks of particles, so that threads need not agree on offsets.
class NeighbourLists {
 public:
  NeighbourLists(const PairLoops& loops, const PairScale& scale) : loops_(&loops), scale_(scale) {}

  /// Finds the pairs of `positions`, which `grid` has sorted. Sums are without boundary.
  void find(const CellGrid& grid, const std::vector<Float4>& positions, const Team& team);

  /// Adds a boundary, whose grid has the geometry of the one given to `find`, to the sums. Where it mirrors, the
  /// gradient sums hold it as often as wallMirror() says.
  void addBoundary(const Boundary& boundary, WallAnswer answer, const CellGrid& grid,
                   const std::vector<Float4>& positions, const Team& team);

  /// Adds to what has been summed up of one particle; thread-safe for different ones.
  void addToSums(std::size_t i, float density, const Float4& gradient, std::uint16_t neighbours) {
    density_[i] += density;
    Float4& sum = gradientSum_[i];
    sum = {sum.x + gradient.x, sum.y + gradient.y, sum.z + gradient.z, 0};
    neighbours_[i] = static_cast<std::uint16_t>(neighbours_[i] + neighbours);
  }

  PairList chunk(const Chunk& chunk) const {
    return {groups_[chunk.index].data(), groupCount_.data(), static_cast<std::uint32_t>(chunk.first),
            static_cast<std::uint32_t>(chunk.last), scale_.quantum};
  }

  const PairLoops& loops() const { return *loops_; }
  const PairScale& scale() const { return scale_; }

  const std::vector<float>& density() const { return density_; }           ///< ρ/ρ0.
  const std::vector<Float4>& gradientSum() const { return gradientSum_; }  ///< Σ V_j ∇W_ij, boundary included.
  /// The particles of a chunk that are beside a mirroring wall; empty where walls answer once.
  const std::vector<WallContact>& wallContacts(const Chunk& chunk) const { return wallContacts_[chunk.index]; }
  const std::vector<float>& gradientSquares() const { return gradientSquares_; }
  const std::vector<std::uint16_t>& neighbours() const { return neighbours_; }  ///< Boundary included.

  /// Writes how many fluid particles each particle of a chunk has within the support, at its place in `counts`.
  void countFluidNeighbours(const Chunk& chunk, std::vector<std::uint16_t>& counts) const;

  /// Memory that the lists and sums hold, bytes.
  std::uint64_t bytes() const;

 private:
  PairSums sums();
  void addMirror(const WallSums& wall, std::uint32_t i, std::vector<WallContact>& contacts);

  const PairLoops* loops_;
  PairScale scale_;
  std::vector<std::vector<PairGroup>> groups_;  ///< Of each chunk.
  std::vector<std::uint16_t> groupCount_;
  std::vector<std::uint16_t> neighbours_;
  std::vector<float> density_;
  std::vector<Float4> gradientSum_;
  std::vector<float> gradientSquares_;
  std::vector<std::vector<WallContact>> wallContacts_;  ///< Of each chunk.
};

}  // namespace sluice::sim
