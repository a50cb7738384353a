#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bodies.h"
#include "cell_grid.h"
#include "container.h"
#include "moving_bodies.h"
#include "particles.h"

namespace sluice::sim {

/// How close to a wall a particle may come, in spacings, before it is held there; no particle starts nearer.
inline constexpr float kHoldingDistance = 0.5F;

/// The last resort against particles that leave: pressure keeps them about one spacing from the container's faces and
/// the bodies; only a fast one that flies alone gets near, because a lone particle is not compressed by its speed.
class Walls {
 public:
  /// `bodies` and `moving` must outlive this; `geometry` is that of the cells that particles are sorted into.
  Walls(const Container& container, double spacing, const Bodies& bodies, const CellGeometry& geometry,
        const MovingBodies& moving)
      : bodies_(&bodies),
        moving_(moving.empty() ? nullptr : &moving),
        geometry_(geometry),
        nearCells_(bodies.nearCells(geometry)),
        clearance_(kHoldingDistance * static_cast<float>(spacing)),
        periodic_(container.periodic),
        period_{static_cast<float>(container.period()[0]), static_cast<float>(container.period()[1]),
                static_cast<float>(container.period()[2])},
        enclosure_(container.enclosure),
        high_{static_cast<float>(container.size[0]) - clearance_, static_cast<float>(container.size[1]) - clearance_,
              static_cast<float>(container.size[2]) - clearance_} {}

  /// Moves a particle from `x` to `to`, or as far as it gets: it slides along what is in its way, and loses the part of
  /// its velocity that leads into it; bodies that move get it handed on in `push`.
  /// Returns whether it had to be held.
  bool move(Float4& x, Float4& v, const Float4& to, BodyPush& push) const {
    if (moving_ != nullptr) return moveAmongMovingBodies(x, v, to, push);
    return moveAmongWalls(x, v, to);
  }

  /// Bodies that a particle may touch or feel within a step.
  BodySet nearBodies(const Float4& x) const { return nearCells_.empty() ? 0 : nearCells_[geometry_.cellOf(x)]; }

  std::uint64_t bytes() const { return nearCells_.size() * sizeof(BodySet); }

 private:
  bool moveAmongMovingBodies(Float4& x, Float4& v, const Float4& to, BodyPush& push) const;
  bool moveAmongBodies(Float4& x, Float4& v, const Float4& to, BodySet near) const;

  bool moveAmongWalls(Float4& x, Float4& v, const Float4& to) const {
    if (const BodySet near = nearBodies(x); near != 0) return moveAmongBodies(x, v, to, near);
    x = to;
    return hold(x, v);
  }

  /// Holds a particle inside the faces, without the part of its velocity that leads out. Returns whether it had to. In
  /// a periodic box, lets it come in again at the other side.
  bool hold(Float4& x, Float4& v) const {
    if (enclosure_) return holdInside(x, v);
    if (periodic_) {
      wrap(x);
      return false;
    }
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

  bool holdInside(Float4& x, Float4& v) const;

  /// A move is shorter than a period.
  void wrap(Float4& x) const {
    const auto inside = [](float place, float length) {
      return place < 0 ? place + length : place >= length ? place - length : place;
    };
    x.x = inside(x.x, period_[0]);
    x.y = inside(x.y, period_[1]);
    if (period_[2] > 0) x.z = inside(x.z, period_[2]);
  }

  const Bodies* bodies_;
  const MovingBodies* moving_;  ///< Null where there are none.
  CellGeometry geometry_;
  std::vector<BodySet> nearCells_;  ///< Of each cell; empty where there are no bodies.
  float clearance_;
  bool periodic_;
  std::array<float, 3> period_;
  std::optional<solids::Enclosure> enclosure_;  ///< The container's, where it is no plain box.
  std::array<float, 3> high_;
};

}  // namespace sluice::sim
