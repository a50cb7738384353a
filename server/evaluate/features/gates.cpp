#include "features/gates.h"

#include <array>
#include <sstream>

namespace sluice::evaluate {

namespace {

constexpr Motion kFlyBy{.camera = true};
constexpr Motion kSimulation{.particles = true};
constexpr Motion kBoth{.camera = true, .particles = true};
constexpr Motion kTwoLiquids{.camera = true, .twoLiquids = true};
constexpr Motion kMovingBodies{.bodies = true};
constexpr Motion kStill{};

// In the sheet, and before it.
constexpr std::string_view kBodies =
    "bodies[0].box.size=0.3,0.3,0.3 bodies[0].position=1.2,0.1,0.5 bodies[1].sphere.radius=0.2 "
    "bodies[1].position=1.5,0.2,1.3";
constexpr std::string_view kBoxWithoutFloor =
    "bodies[0].box.size=0.3,0.3,0.3 bodies[0].position=1.2,0.1,0.5 background.floor=false";
// Around the liquid.
constexpr std::string_view kTank =
    "bodies[0].box.size=2.1,1.2,1.1 bodies[0].box.open_top=true bodies[0].position=1,0.6,0.5 bodies[0].glass={}";

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
    Gate{"look-up behind the liquid", "background.floor=false", "background.floor=false background.uniform={}", kFlyBy,
         kFlyBy},
    Gate{"a second liquid", "", "", kTwoLiquids, kFlyBy},
    Gate{"reflection", "", "look.liquid.no_reflection={}", kFlyBy, kFlyBy},
    Gate{"environment", "", "background.backdrop={}", kFlyBy, kFlyBy},
    Gate{"shadow", "", "lighting.sun.shadow=0", kBoth, kBoth},
    Gate{"foam", "foam={}", "", kBoth, kBoth},
    Gate{"velocity map", "look.velocity_map={}", "", kBoth, kBoth},
    Gate{"colour map", "look.colour_map={}", "", kBoth, kBoth},
    Gate{"lamps", "lighting.point_lights[0]={} lighting.point_lights[1].position=1,2,2", "", kFlyBy, kFlyBy},
    Gate{"bodies", kBodies, "", kFlyBy, kFlyBy},
    Gate{"bodies in a cube map", "", "look.liquid.surroundings={}", kMovingBodies, kMovingBodies, kBodies},
    Gate{"bodies mirrored in the screen", "look.liquid.screen_space={}", "look.liquid.surroundings={}", kFlyBy, kFlyBy,
         kBodies},
    // Without a floor shadows fall on bodies alone.
    Gate{"shadows on bodies", "", "lighting.sun.shadow=0", kMovingBodies, kMovingBodies, kBoxWithoutFloor},
    Gate{"bodies that move", "", "", kMovingBodies, kSimulation, kBoxWithoutFloor},
    Gate{"glass", kTank, "", kFlyBy, kFlyBy},
    Gate{"caustics", "", "lighting.sun.caustics=0", kBoth, kBoth},
    Gate{"floor", "", "background.floor=false", kBoth, kBoth},
    Gate{"splats deep inside", "look.splats.skip_interior=false", "look.splats.skip_interior=true", kFlyBy, kFlyBy},
    Gate{"background of a moving camera", "", "", kBoth, kSimulation},
    Gate{"upload and shadow of new particles", "", "", kBoth, kFlyBy},
    Gate{"frames in which nothing changes", "", "", kFlyBy, kStill},
};

}  // namespace

std::span<const Gate> gates() { return kGates; }

std::vector<std::string> assignmentsOf(std::string_view assignments) {
  std::istringstream words{std::string(assignments)};
  std::vector<std::string> each;
  for (std::string word; words >> word;) each.push_back(word);
  return each;
}

}  // namespace sluice::evaluate
