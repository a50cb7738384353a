// Whole pictures have the same bits for 1, 2 and 4 threads.
#include <omp.h>

#include "render_test.h"

namespace sluice::testing {
namespace {

class PictureThreads : public RenderTest {
 protected:
  /// The bench cloud, moving, with foam over it.
  static core::ParticleSnapshot cloudWithFoam(double time) {
    core::ParticleSnapshot particles = columnAndSheet(6000);
    particles.time = time;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Eigen::Vector3f& p = particles.positions[i];
      particles.ids.push_back(static_cast<std::uint32_t>(i));
      particles.velocities.emplace_back(0, time > 0 && i % 3 == 0 ? 4.0F : 0.0F, 0);
      particles.densities.push_back(i % 50 == 0 ? 200.0F : 1000.0F);
      if (i % 4 != 0) continue;
      particles.diffuse.positions.push_back(p + Eigen::Vector3f(0, 0.05F, 0));
      particles.diffuse.velocities.emplace_back(Eigen::Vector3f::Zero());
      particles.diffuse.kinds.push_back(static_cast<core::DiffuseKind>(i / 4 % 3));
      particles.diffuse.remaining.push_back(0.7F);
      particles.diffuse.ids.push_back(static_cast<std::uint32_t>(i));
    }
    return particles;
  }

  /// Radiance drawn by a renderer of its own.
  std::vector<float> drawOn(int threads) {
    const int usual = omp_get_max_threads();
    omp_set_num_threads(threads);
    render::FluidRenderer fresh(context());
    fresh.follow(cloudWithFoam(0), scene);
    fresh.render(cloudWithFoam(0.04), scene, columnAndSheetCamera(), {317, 239});
    omp_set_num_threads(usual);
    return fresh.readRadiance().values;
  }

  void expectSameBits() {
    const std::vector<float> one = drawOn(1);
    ASSERT_FALSE(one.empty());
    for (const int threads : {2, 4}) EXPECT_TRUE(one == drawOn(threads)) << threads << " threads";
  }
};

TEST_F(PictureThreads, DoNotChangeTheDefaultLookWithFoamAndNoise) {
  assign({"foam={}", "look.noise={}", "lighting.sun.caustics=1"});
  expectSameBits();
}

TEST_F(PictureThreads, DoNotChangeEllipsoidsWithTwoInterfacesAndAVelocityMap) {
  assign({"look.splats.ellipsoid={}", "look.liquid.two_interfaces={}", "look.velocity_map={}"});
  expectSameBits();
}

TEST_F(PictureThreads, DoNotChangeAMetalAtHalfSizeSmoothedByExplicitFlow) {
  assign({"look.liquid.metal={}", "look.smoothing.rkl_curvature_flow={}", "look.smoothing.divisor=2",
          "look.colour_map={strength: 0.5}"});
  expectSameBits();
}

}  // namespace
}  // namespace sluice::testing
