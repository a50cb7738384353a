#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bodies.h"
#include "cell_grid.h"
#include "container.h"
#include "particles.h"

namespace sluice::sim {

/// How close to a wall a particle may come, in spacings, before it is held there; no particle starts nearer.
inline constexpr float kHoldingDistance = 0.5F;

/// The last resort against particles that leave: pressure keeps them about one spacing from the container's faces and
/// the bodies; only a fast one that flies alone gets near, because a lone particle is not compressed by its speed.
class Walls {
 public:
  /// `bodies` must outlive this; `geometry` is that of the cells that particles are sorted into.
  Walls(const Container& container, double spacing, const Bodies& bodies, const CellGeometry& geometry)
      : bodies_(&bodies),
        geometry_(geometry),
        nearCells_(bodies.nearCells(geometry)),
        clearance_(kHoldingDistance * static_cast<float>(spacing)),
        high_{static_cast<float>(container.size[0]) - clearance_, static_cast<float>(container.size[1]) - clearance_,
              static_cast<float>(container.size[2]) - clearance_} {}

  /// Moves a particle from `x` to `to`, or as far as it gets: it slides along what is in its way, and loses the part of
  /// its velocity that leads into it. Returns whether it had to be held.
  bool move(Float4& x, Float4& v, const Float4& to) const {
    if (const BodySet near = nearBodies(x); near != 0) return moveAmongBodies(x, v, to, near);
    x = to;
    return hold(x, v);
  }

  /// Bodies that a particle may touch or feel within a step.
  BodySet nearBodies(const Float4& x) const { return nearCells_.empty() ? 0 : nearCells_[geometry_.cellOf(x)]; }

  std::uint64_t bytes() const { return nearCells_.size() * sizeof(BodySet); }

 private:
  bool moveAmongBodies(Float4& x, Float4& v, const Float4& to, BodySet near) const;

  /// Holds a particle inside the faces, without the part of its velocity that leads out. Returns whether it had to.
  bool hold(Float4& x, Float4& v) const {
    const bool heldX = hold(x.x, v.x, high_[0]);
    const bool heldY = hold(x.y, v.y, high_[1]);
    const bool heldZ = hold(x.z, v.z, high_[2]);
    return heldX || heldY || heldZ;
  }

  bool hold(float& position, float& velocity, float high) const {
    if (position >= clearance_ && position <= high) return false;
    const bool below = position < clearance_;
    position = below ? clearance_ : high;
    if (below == (velocity < 0)) velocity = 0;
    return true;
  }

  const Bodies* bodies_;
  CellGeometry geometry_;
  std::vector<BodySet> nearCells_;  ///< Of each cell; empty where there are no bodies.
  float clearance_;
  std::array<float, 3> high_;
};

}  // namespace sluice::sim
