// The loops over pairs on a full lattice, for each instruction set that the machine runs.

#include <string>

#include <benchmark/benchmark.h>

#include "lattice.h"
#include "neighbour_lists.h"

namespace sluice::sim {
namespace {

constexpr double kSpacing = 0.05;
constexpr double kSupport = 0.1;
constexpr int kEdge = 31;  // 29,791 particles

struct Lattice {
  CellGrid grid{CellGeometry::covering({kEdge * kSpacing, kEdge* kSpacing, kEdge* kSpacing}, kSupport, 1 << 20)};
  std::vector<Float4> positions;
  PairScale scale{
      {3, KernelKind::CubicSpline, kSpacing, kSupport, particleVolume(KernelKind::CubicSpline, kSpacing, kSupport)}};

  Lattice() {
    std::vector<Float4> points;
    for (int z = 0; z < kEdge; ++z) {
      for (int y = 0; y < kEdge; ++y) {
        for (int x = 0; x < kEdge; ++x) {
          // A little shear, so that neighbours do not all lie exactly on the edge of the support.
          points.push_back({0.05F * static_cast<float>(x) + 0.003F * static_cast<float>(y % 3),
                            0.05F * static_cast<float>(y), 0.05F * static_cast<float>(z), 0});
        }
      }
    }
    grid.sort(points, Team(1));
    for (const std::uint32_t from : grid.order()) positions.push_back(points[from]);
  }
};

void setRate(benchmark::State& state, const PairLoops& loops, std::size_t particles) {
  state.SetLabel(std::string(loops.instructionSet));
  state.counters["ns_per_particle"] =
      benchmark::Counter(static_cast<double>(particles) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

const PairLoops* loopsOf(benchmark::State& state) {
  const auto available = availablePairLoops();
  const auto index = static_cast<std::size_t>(state.range(0));
  if (index < available.size()) return available[index];
  state.SkipWithError("this machine does not have the instruction set");
  return nullptr;
}

void SortByCell(benchmark::State& state) {
  const Lattice lattice;
  CellGrid grid = lattice.grid;
  for (auto unused : state) grid.sort(lattice.positions, Team(1));
}
BENCHMARK(SortByCell)->Unit(benchmark::kMicrosecond);

void FindNeighbours(benchmark::State& state) {
  const PairLoops* loops = loopsOf(state);
  if (loops == nullptr) return;
  const Lattice lattice;
  NeighbourLists lists(*loops, lattice.scale);
  for (auto unused : state) lists.find(lattice.grid, lattice.positions, Team(1));
  setRate(state, *loops, lattice.positions.size());
}
BENCHMARK(FindNeighbours)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

void ApplyImpulses(benchmark::State& state) {
  const PairLoops* loops = loopsOf(state);
  if (loops == nullptr) return;
  const Lattice lattice;
  NeighbourLists lists(*loops, lattice.scale);
  lists.find(lattice.grid, lattice.positions, Team(1));
  const std::size_t particles = lattice.positions.size();
  const std::vector<Float4> velocity(particles, Float4{1, 2, 3, 0});
  const std::vector<Float4> impulse(particles, Float4{1, 1, 1, 1});
  std::vector<Float4> result(particles);
  for (auto unused : state) {
    Team(1).forEachChunk(particles, [&](const Chunk& chunk) {
      loops->applyImpulses(lists.chunk(chunk), {}, impulse.data(), lists.gradientSum().data(), velocity.data(),
                           result.data());
    });
    benchmark::ClobberMemory();
  }
  setRate(state, *loops, particles);
}
BENCHMARK(ApplyImpulses)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sluice::sim
