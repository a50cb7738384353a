// Speed of DFSPH on double_dam_break, from the start to the end of the first simulated second.

#include <algorithm>
#include <string>

#include <benchmark/benchmark.h>

#include "fluid_simulation.h"

namespace sluice::sim {
namespace {

void set(v1::Vec3* v, double x, double y, double z) {
  v->set_x(x);
  v->set_y(y);
  v->set_z(z);
}

/// Two columns in opposite corners of a closed cube. 24 particles wide it is the shipped scene double_dam_break.
v1::Simulation doubleDamBreak(std::uint32_t width, std::uint32_t height, double cubeEdge) {
  constexpr double kSpacing = 0.05;
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), 0, -9.81, 0);
  const double half = cubeEdge / 2;
  set(simulation.mutable_container()->mutable_min(), -half, -kSpacing, -half);
  set(simulation.mutable_container()->mutable_max(), half, cubeEdge - kSpacing, half);
  v1::Fluid* fluid = simulation.add_fluids();
  fluid->set_viscosity(0.01);
  const double low = -half + 2 * kSpacing;
  const double high = half - 2 * kSpacing - (width - 1) * kSpacing;
  for (const double corner : {low, high}) {
    v1::Block* block = fluid->add_blocks();
    set(block->mutable_first_particle(), corner, kSpacing, corner);
    block->set_count_x(width);
    block->set_count_y(height);
    block->set_count_z(width);
  }
  return simulation;
}

void report(benchmark::State& state, const FluidSimulation& simulation, const core::StepStatistics& sums) {
  const auto steps = static_cast<double>(simulation.statistics().steps);
  state.counters["steps"] = steps;
  state.counters["particles"] = static_cast<double>(simulation.state().size());
  state.counters["density_iterations"] = sums.densityIterations / steps;
  state.counters["divergence_iterations"] = sums.divergenceIterations / steps;
  state.counters["mean_density_error_percent"] = 100 * sums.meanDensityError / steps;
  state.counters["max_density_error_percent"] = 100 * sums.maxDensityError;
  state.counters["ms_per_step"] = core::totalMilliseconds(sums.stages) / steps;
  for (const core::StageTime& stage : sums.stages) state.counters["ms " + stage.name] = stage.milliseconds / steps;
  double bytes = 0;
  for (const core::PlannedBuffer& buffer : simulation.plan().buffers) bytes += static_cast<double>(buffer.bytes);
  state.counters["bytes_per_particle"] = bytes / static_cast<double>(simulation.state().size());
}

/// Advances by `seconds`, adding the statistics of every step to `sums` (the largest, for the maximum).
void run(FluidSimulation& simulation, double seconds, core::StepStatistics& sums) {
  while (simulation.time() < seconds && simulation.advance()) {
    const core::StepStatistics step = simulation.statistics();
    sums.densityIterations += step.densityIterations;
    sums.divergenceIterations += step.divergenceIterations;
    sums.meanDensityError += step.meanDensityError;
    sums.maxDensityError = std::max(sums.maxDensityError, step.maxDensityError);
    for (const core::StageTime& stage : step.stages) core::addStageTime(sums.stages, stage.name, stage.milliseconds);
  }
}

void firstSecond(benchmark::State& state, const v1::Simulation& scene, double seconds) {
  for (auto unused : state) {
    state.PauseTiming();
    FluidSimulation simulation(scene, {.threads = static_cast<int>(state.range(0))});
    core::StepStatistics sums;
    state.ResumeTiming();
    run(simulation, seconds, sums);
    state.PauseTiming();
    report(state, simulation, sums);
    state.ResumeTiming();
  }
}

void DoubleDamBreak(benchmark::State& state) { firstSecond(state, doubleDamBreak(24, 26, 3.1), 1); }
BENCHMARK(DoubleDamBreak)->ArgName("threads")->Arg(1)->Arg(2)->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);

void DoubleDamBreak101k(benchmark::State& state) { firstSecond(state, doubleDamBreak(36, 39, 4.6), 0.25); }
BENCHMARK(DoubleDamBreak101k)->ArgName("threads")->Arg(2)->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);

}  // namespace
}  // namespace sluice::sim

BENCHMARK_MAIN();
