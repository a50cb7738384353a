// Leaving the inside of a liquid out of the surface does not change a pixel of a breaking column.
#include "render_test.h"
#include "sluice/scene/convert.h"
#include "sluice/sim/simulation.h"

namespace sluice::testing {
namespace {

class SkipInterior : public RenderTest {};

TEST_F(SkipInterior, ChangesNoPixelOfADamBreak) {
  const v1::Scene dam = scene::loadShipped("dam_break");
  const std::unique_ptr<core::ParticleSource> source = sim::makeSimulation(dam);
  const core::Camera camera = scene::toCamera(dam.camera());
  // From above the far wall, through which the whole inside would be seen if the liquid there were skipped.
  const core::Camera other{{-1.8F, 0.9F, -1.4F}, {0, 0.3F, 0}, {0, 1, 0}, 45.0F};
  const core::ImageSize size{640, 480};
  for (const double time : {0.0, 0.3, 0.6, 1.0}) {
    while (source->time() < time && source->advance()) {
    }
    const std::unique_ptr<core::ParticleSnapshot> particles = source->snapshot();
    for (const char* shape : {"sphere", "ellipsoid", "disc"}) {
      v1::Splats& splats = *look.mutable_splats();
      splats.GetReflection()->MutableMessage(&splats, v1::Splats::descriptor()->FindFieldByName(shape));
      scene::complete(splats);
      for (const core::Camera& view : {camera, other}) {
        splats.set_skip_interior(true);
        const core::Frame skipped = render(*particles, view, size);
        bool skips = false;
        for (const core::LeftOut& entry : renderer.plan().leftOut) {
          skips = skips || entry.reason == "they are deep inside the liquid";
        }
        EXPECT_TRUE(skips) << "nothing was skipped: this shows nothing";
        splats.set_skip_interior(false);
        EXPECT_EQ(skipped.pixels, render(*particles, view, size).pixels) << shape << " at " << time << " s";
      }
    }
  }
}

}  // namespace
}  // namespace sluice::testing
