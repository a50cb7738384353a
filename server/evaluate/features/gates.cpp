#include "features/gates.h"

#include <array>

namespace sluice::evaluate {

namespace {

constexpr Motion kFlyBy{.camera = true, .particles = false};
constexpr Motion kSimulation{.camera = false, .particles = true};
constexpr Motion kBoth{.camera = true, .particles = true};
constexpr Motion kStill{};

// What may be left out, as far as it is about the surface and its picture.
constexpr std::array kGates{
    Gate{"thickness and refraction", "", "look.liquid.opaque=true", kFlyBy, kFlyBy},
    Gate{"smoothing of the thickness", "", "look.thickness.smoothing_in_spacings=0", kFlyBy, kFlyBy},
    Gate{"thickness at full resolution", "look.thickness.divisor=1", "look.thickness.divisor=4", kFlyBy, kFlyBy},
    Gate{"smoothing", "", "look.smoothing.time=0", kFlyBy, kFlyBy},
    Gate{"liquid at full resolution", "look.smoothing.divisor=1", "look.smoothing.divisor=2", kFlyBy, kFlyBy},
    Gate{"liquid at half resolution", "look.smoothing.divisor=2", "look.smoothing.divisor=4", kFlyBy, kFlyBy},
    Gate{"highlight", "", "look.liquid.physical.specular=0", kFlyBy, kFlyBy},
    Gate{"noise", "look.noise.amplitude=0.2", "look.noise.amplitude=0", kSimulation, kSimulation},
    Gate{"whitening by noise", "look.noise.whitening=0.6", "look.noise.whitening=0", kSimulation, kSimulation},
    Gate{"second interface", "look.liquid.two_interfaces={}", "look.liquid.snell={}", kFlyBy, kFlyBy},
    Gate{"reflection", "", "look.liquid.no_reflection={}", kFlyBy, kFlyBy},
    Gate{"environment", "", "background.backdrop={}", kFlyBy, kFlyBy},
    Gate{"shadow", "", "lighting.sun.shadow=0", kBoth, kBoth},
    Gate{"foam", "foam={}", "", kBoth, kBoth},
    Gate{"caustics", "", "lighting.sun.caustics=0", kBoth, kBoth},
    Gate{"floor", "", "background.floor=false", kBoth, kBoth},
    Gate{"splats deep inside", "look.splats.skip_interior=false", "look.splats.skip_interior=true", kFlyBy, kFlyBy},
    Gate{"background of a moving camera", "", "", kBoth, kSimulation},
    Gate{"upload and shadow of new particles", "", "", kBoth, kFlyBy},
    Gate{"frames in which nothing changes", "", "", kFlyBy, kStill},
};

}  // namespace

std::span<const Gate> gates() { return kGates; }

}  // namespace sluice::evaluate
