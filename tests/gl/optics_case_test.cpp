// Every kind of liquid, light and surroundings before every camera that breaks careless renderers: no GL error, nothing
// that is not finite, the same picture twice. Each value of each choice occurs, and the pairs that share a shader.
#include "camera_cases.h"
#include "render_test.h"

namespace sluice::testing {
namespace {

struct Optics {
  std::string name;
  std::vector<std::string> assignments;  ///< As with --set.
  std::size_t liquids = 1;
};

void PrintTo(const Optics& optics, std::ostream* out) { *out << optics.name; }

/// The bench cloud with all that a source may tell: dense and stray, calm and violent particles of as many liquids,
/// with foam around them. `moment` 0 is calm.
core::ParticleSnapshot everything(std::size_t liquids, int moment) {
  core::ParticleSnapshot particles = columnAndSheet(kCameraCaseParticles);
  particles.time = 0.05 * moment;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Eigen::Vector3f& p = particles.positions[i];
    particles.ids.push_back(static_cast<std::uint32_t>(i));
    particles.velocities.emplace_back(0.5F, moment > 0 && i % 2 == 0 ? 5.0F : 0.0F, 0);
    particles.densities.push_back(i % 10 == 0 ? 100.0F : 1000.0F);
    particles.pressures.push_back(9810 * (1 - p.y()));
    particles.ages.push_back(p.x());
    if (liquids > 1) particles.fluids.push_back(static_cast<std::uint8_t>(i * liquids / particles.size()));
    if (i % 5 == 0) {
      particles.diffuse.positions.push_back(p + Eigen::Vector3f(0, 0.03F, 0));
      particles.diffuse.velocities.emplace_back(Eigen::Vector3f::Zero());
      particles.diffuse.kinds.push_back(static_cast<core::DiffuseKind>(i % 3));
      particles.diffuse.remaining.push_back(0.5F);
      particles.diffuse.ids.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return particles;
}

/// A box on the floor before the sheet, a ball half in the column, and a glass tank around all.
const std::vector<std::string> kBodies{"bodies[0].box.size=0.3,0.3,0.3",
                                       "bodies[0].position=1.4,0.15,1.2",
                                       "bodies[1].sphere.radius=0.3",
                                       "bodies[1].position=0.5,0.4,0.5",
                                       "bodies[2].box={size {x: 2.2 y: 1.2 z: 1.2} open_top: true}",
                                       "bodies[2].position=1,0.6,0.5",
                                       "bodies[2].glass={}"};

std::vector<std::string> withBodies(std::vector<std::string> assignments) {
  assignments.insert(assignments.end(), kBodies.begin(), kBodies.end());
  return assignments;
}

class OpticsCases : public RenderTest, public ::testing::WithParamInterface<Optics> {};

TEST_P(OpticsCases, AreFiniteAndRepeatable) {
  const Optics& optics = GetParam();
  assign(optics.assignments);
  renderer.follow(everything(optics.liquids, 0), scene);
  const core::ParticleSnapshot particles = everything(optics.liquids, 1);
  for (const CameraCase& c : cameraCases()) {
    SCOPED_TRACE(c.name);
    const core::Frame first = render(particles, c.camera, c.size);
    const std::vector<float> radiance = renderer.readRadiance().values;
    ASSERT_EQ(radiance.size(), first.pixels.size());
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      ASSERT_TRUE(std::isfinite(radiance[i]))
          << "channel " << i % 4 << " of pixel " << i / 4 % static_cast<std::size_t>(c.size.width) << ' '
          << i / 4 / static_cast<std::size_t>(c.size.width);
    }
    EXPECT_TRUE(first.pixels == render(particles, c.camera, c.size).pixels);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Every, OpticsCases,
    ::testing::Values(
        Optics{"SnellWithWhiteningNoise", {"look.noise.amplitude=5", "look.noise.whitening=1"}},
        Optics{"SnellWithFoamAndSurroundings", {"foam={}", "look.liquid.surroundings={}"}},
        Optics{"SnellAtHalfSize", {"look.smoothing.divisor=2", "foam={}", "look.noise={}"}},
        Optics{"ScreenShiftWithPhong", {"look.liquid.screen_shift={}", "look.liquid.phong={}"}},
        Optics{"ScreenShiftWithNoiseAndNothingMirrored",
               {"look.liquid.screen_shift={}", "look.noise.whitening=0", "look.liquid.no_reflection={}"}},
        Optics{"TwoInterfaces", {"look.liquid.two_interfaces={}", "look.splats.ellipsoid={}"}},
        Optics{"TwoInterfacesWithPhongNoiseAndFoam",
               {"look.liquid.two_interfaces={}", "look.liquid.phong={}", "look.noise={}", "foam={}"}},
        Optics{"TwoInterfacesOfAHighIndex",
               {"look.liquid.two_interfaces={}", "look.liquid.refractive_index=2.4", "look.splats.disc={}"}},
        Optics{"Opaque", {"look.liquid.opaque=true", "look.liquid.phong={}", "foam={}"}},
        Optics{"MetalWithNoise", {"look.liquid.metal={}", "look.noise={}", "look.liquid.physical.roughness=0.01"}},
        Optics{"GlowingWithNoise", {"look.liquid.opaque=true", "look.liquid.emission=90,20,5", "look.noise={}"}},
        Optics{"IndexOfOne", {"look.liquid.refractive_index=1", "look.liquid.two_interfaces={}"}},
        Optics{"VelocityMapWithNoise", {"look.velocity_map={}", "look.noise={}"}},
        Optics{"ColourMap",
               {"look.colour_map.pressure={}", "look.colour_map.magma={}", "look.colour_map.strength=0.7"}},
        Optics{"Bodies", withBodies({"look.liquid.cube_map={}", "foam={}"})},
        Optics{"BodiesInTwoInterfaces", withBodies({"look.liquid.two_interfaces={}", "look.liquid.screen_space={}"})},
        Optics{"BodiesInMetalWithNoise",
               withBodies({"look.liquid.metal={}", "look.noise={}", "look.liquid.screen_space={}"})},
        Optics{"BodiesUnderLampsAlone",
               withBodies({"lighting.sun.direction=0,-1,0", "lighting.point_lights[0].position=1,0.3,0.5",
                           "lighting.point_lights[1].position=0.25,0.5,0.5", "look.liquid.screen_shift={}"})},
        Optics{"BodiesAtHalfSize", withBodies({"look.smoothing.divisor=2", "look.velocity_map={}"})},
        Optics{"UniformLight", {"background.uniform.radiance=100,100,100", "tone.filmic={}"}},
        Optics{"Backdrop", {"background.backdrop={}", "background.floor=false", "tone.reinhard={}"}},
        Optics{"StrongSunAndSky", {"lighting.sun.strength=100", "background.sky.horizon=4,4,4", "look.noise={}"}},
        Optics{"ThreeLiquids",
               {"more_looks[0].liquid.two_interfaces={}", "more_looks[0].noise={}", "more_looks[1].liquid.metal={}",
                "foam={}", "look.noise={}"},
               3},
        Optics{"ThreeLiquidsWithMaps",
               {"look.velocity_map={}", "more_looks[0].colour_map={}", "more_looks[0].liquid.screen_shift={}",
                "more_looks[0].smoothing.divisor=2", "more_looks[1].liquid={opaque: true emission {x: 3}}"},
               3},
        Optics{"TwoLiquidsAroundBodies",
               withBodies({"look.liquid.two_interfaces={}", "more_looks[0].liquid.phong={}", "foam={}"}), 2}),
    [](const auto& optics) { return optics.param.name; });

}  // namespace
}  // namespace sluice::testing
