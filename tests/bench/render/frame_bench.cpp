// A whole frame of the bench cloud at 1024x768: upload, every pass, and read-back, with a camera that moves a little
// from frame to frame. Counters give the mean milliseconds of each pass.
#include <benchmark/benchmark.h>

#include <map>

#include "column_and_sheet.h"
#include "sluice/gl/context.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/scene/scene.h"

namespace sluice {
namespace {

void frame(benchmark::State& state, void (*choose)(v1::Look&)) {
  const std::unique_ptr<gl::Context> context = gl::Context::create();
  render::FluidRenderer renderer(*context);
  v1::Scene scene;
  choose(*scene.mutable_look());
  scene::complete(scene);
  core::ParticleSnapshot particles = testing::columnAndSheet(static_cast<std::size_t>(state.range(0)));
  core::Camera camera = testing::columnAndSheetCamera();
  std::map<std::string, double> passes;
  renderer.render(particles, scene, camera, {1024, 768});
  for (auto _ : state) {
    camera.eye.x() += 1e-4F;
    ++particles.sequence;
    const core::Frame picture = renderer.render(particles, scene, camera, {1024, 768});
    for (const core::StageTime& stage : picture.tag.stages) passes[stage.name] += stage.milliseconds;
  }
  for (const auto& [pass, milliseconds] : passes) {
    state.counters[pass + " ms"] = benchmark::Counter(milliseconds, benchmark::Counter::kAvgIterations);
  }
}

void chooseDefault(v1::Look&) {}
void chooseBilateral(v1::Look& look) { look.mutable_smoothing()->mutable_bilateral(); }
void chooseNone(v1::Look& look) { look.mutable_smoothing()->set_time(0); }
void chooseOpaque(v1::Look& look) { look.mutable_liquid()->set_opaque(true); }

BENCHMARK_CAPTURE(frame, default_look, chooseDefault)
    ->Arg(64000)
    ->Arg(16000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, bilateral, chooseBilateral)->Arg(64000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(frame, unsmoothed, chooseNone)->Arg(64000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(frame, opaque, chooseOpaque)->Arg(64000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace sluice

BENCHMARK_MAIN();
