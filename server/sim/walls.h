#pragma once

#include <array>

#include "container.h"
#include "particles.h"

namespace sluice::sim {

/// The last resort against particles that leave: pressure keeps them about one spacing from the faces; only a fast one
/// that flies alone gets near, because a lone particle is not compressed by its speed.
class Walls {
 public:
  Walls(const Container& container, double spacing)
      : periodic_(container.periodic),
        period_{static_cast<float>(container.period()[0]), static_cast<float>(container.period()[1]),
                static_cast<float>(container.period()[2])},
        clearance_(kHoldingDistance * static_cast<float>(spacing)),
        high_{static_cast<float>(container.size[0]) - clearance_, static_cast<float>(container.size[1]) - clearance_,
              static_cast<float>(container.size[2]) - clearance_} {}

  /// Holds a particle inside the faces, without the part of its velocity that leads out. Returns whether it had to. In
  /// a periodic box, lets it come in again at the other side.
  bool hold(Float4& x, Float4& v) const {
    if (periodic_) {
      wrap(x);
      return false;
    }
    const bool heldX = hold(x.x, v.x, high_[0]);
    const bool heldY = hold(x.y, v.y, high_[1]);
    const bool heldZ = hold(x.z, v.z, high_[2]);
    return heldX || heldY || heldZ;
  }

 private:
  // How close to a face a particle may come, in spacings, before it is held there.
  static constexpr float kHoldingDistance = 0.5F;

  bool hold(float& position, float& velocity, float high) const {
    if (position >= clearance_ && position <= high) return false;
    const bool below = position < clearance_;
    position = below ? clearance_ : high;
    if (below == (velocity < 0)) velocity = 0;
    return true;
  }

  /// A move is shorter than a period.
  void wrap(Float4& x) const {
    const auto inside = [](float place, float length) {
      return place < 0 ? place + length : place >= length ? place - length : place;
    };
    x.x = inside(x.x, period_[0]);
    x.y = inside(x.y, period_[1]);
    if (period_[2] > 0) x.z = inside(x.z, period_[2]);
  }

  bool periodic_;
  std::array<float, 3> period_;
  float clearance_;
  std::array<float, 3> high_;
};

}  // namespace sluice::sim
