#pragma once

#include <optional>
#include <span>
#include <vector>

#include "container.h"
#include "particles.h"
#include "sluice/solids/placed_body.h"
#include "team.h"
#include "touch.h"

namespace sluice::sim {

/// A stretch of a ray, as distances from its origin, m.
struct Stretch {
  double first = 0;
  double last = 0;
};

/// Where a ray runs through the container; none where it misses it. A planar scene's has no ends along z.
std::optional<Stretch> insideContainer(const TouchRay& ray, const Container& container);

/// How far along a ray it first meets a particle, as a ball with half the diagonal of the lattice's cell as its radius,
/// through which a ray finds no gap; none where it meets none.
std::optional<double> firstParticle(const TouchRay& ray, const std::vector<Float4>& positions, double spacing,
                                    const Team& team);

/// How far along a ray, within a stretch of it, it first meets one of the bodies, to a hundredth of a spacing [sphere
/// tracing, Hart 1996]; none where it meets none.
std::optional<double> firstBody(const TouchRay& ray, const Stretch& stretch,
                                std::span<const solids::PlacedBody* const> bodies, double spacing);

}  // namespace sluice::sim
