// The dam break of Martin & Moyce 1952: a column of water, twice as high as wide, let go.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sluice/evaluate/report.h"
#include "solvers/run.h"
#include "solvers/scenes.h"

namespace sluice::evaluate {

namespace {

constexpr double kGravity = 9.81;
constexpr double kWidth = 0.05715;  ///< a = 2.25 in, m.
constexpr double kWater = 1e-6;     ///< Kinematic viscosity, m²/s.

struct Sample {
  double time;
  double value;
};

/// Front Z = z/a over T = t √(2g/a), table 2, where T < 3.3.
constexpr std::array<Sample, 14> kFront{{{0.41, 1.11},
                                         {0.84, 1.22},
                                         {1.19, 1.44},
                                         {1.43, 1.67},
                                         {1.63, 1.89},
                                         {1.83, 2.11},
                                         {1.98, 2.33},
                                         {2.20, 2.56},
                                         {2.32, 2.78},
                                         {2.51, 3.00},
                                         {2.65, 3.22},
                                         {2.83, 3.44},
                                         {2.98, 3.67},
                                         {3.11, 3.89}}};

/// Height of the residual column H = η/2a over τ = t √(g/a), table 6: as far as the front's table reaches.
constexpr std::array<Sample, 11> kHeight{{{0.56, 0.94},
                                          {0.77, 0.89},
                                          {0.93, 0.83},
                                          {1.08, 0.78},
                                          {1.28, 0.72},
                                          {1.46, 0.67},
                                          {1.66, 0.61},
                                          {1.84, 0.56},
                                          {2.00, 0.50},
                                          {2.21, 0.44},
                                          {2.45, 0.39}}};

/// Linear between the points of a course; its ends beyond them.
double at(const std::vector<Sample>& course, double time) {
  const auto after = std::ranges::lower_bound(course, time, {}, &Sample::time);
  if (after == course.begin()) return course.front().value;
  if (after == course.end()) return course.back().value;
  const Sample& before = *(after - 1);
  return before.value + (after->value - before.value) * (time - before.time) / (after->time - before.time);
}

/// Largest relative difference of a course, delayed, to what was measured.
template <std::size_t n>
double largestError(const std::vector<Sample>& course, const std::array<Sample, n>& measured, double delay) {
  double largest = 0;
  for (const Sample& sample : measured) {
    largest = std::max(largest, std::abs(at(course, sample.time - delay) / sample.value - 1));
  }
  return largest;
}

/// The delay (in the front's units of time) by which the gate, which took its time to open, held the water back: that
/// of the least mean square of the front's relative errors.
double fittedDelay(const std::vector<Sample>& front) {
  double best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (double delay = -0.2; delay <= 0.6; delay += 0.005) {
    double sum = 0;
    for (const Sample& sample : kFront) sum += std::pow(at(front, sample.time - delay) / sample.value - 1, 2);
    if (sum >= least) continue;
    least = sum;
    best = delay;
  }
  return best;
}

/// Largest x of the particles that are no spray, and largest y of those by the wall.
struct Extent {
  double front = 0;
  double height = 0;
};

Extent extentOf(const core::ParticleSnapshot& particles) {
  constexpr std::uint16_t kTogether = 4;  // with fewer neighbours a particle has left the front
  Extent extent;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.neighbours[i] < kTogether) continue;
    const Eigen::Vector3f& x = particles.positions[i];
    // From the middle between wall and fluid, half a spacing before the face, to half a spacing before the particle.
    extent.front = std::max(extent.front, static_cast<double>(x.x()));
    if (x.x() < 3 * particles.spacing) extent.height = std::max(extent.height, static_cast<double>(x.y()));
  }
  return extent;
}

std::vector<Finding> damBreak(Run& run) {
  const int across = run.resolution();
  const double spacing = kWidth / across;
  v1::Simulation simulation = planarScene(spacing, {0, 0, 8 * kWidth, 3 * kWidth});
  simulation.mutable_gravity()->set_y(-kGravity);
  simulation.mutable_fluids(0)->set_viscosity(kWater);
  run.start(simulation, {.positions = block(spacing, 1, across, 2 * across)});

  const double frontUnit = std::sqrt(kWidth / (2 * kGravity));
  const double heightUnit = std::sqrt(kWidth / kGravity);
  std::vector<Sample> front{{0, 1}};
  std::vector<Sample> height{{0, 1}};
  const bool done = run.runTo(3.6 * frontUnit, [&](const core::ParticleSource& source) {
    const Extent extent = extentOf(*source.snapshot());
    front.push_back({source.time() / frontUnit, extent.front / kWidth});
    height.push_back({source.time() / heightUnit, extent.height / (2 * kWidth)});
  });
  if (!done) return {};

  const double delay = fittedDelay(front);
  const std::string gate = "; gate delay fitted, " + shortText(delay) + " sqrt(a/2g)";
  const double late = (at(front, 3.3) - at(front, 2.3)) / 1.0;
  return {
      {"front, largest relative, T < 3.3", largestError(front, kFront, delay), "Martin & Moyce 1952, table 2" + gate},
      {"height, largest relative, tau < 2.5", largestError(height, kHeight, delay / std::sqrt(2.0)),
       "Martin & Moyce 1952, table 6" + gate},
      {"front speed below the frictionless", 1 - late / 2, "Ritter 1892, 2 sqrt(g H): Z = 1 + 2 T"}};
}

}  // namespace

std::vector<Case> damBreakCases() { return {{"dam break", {10, 20}, {10, 20, 40, 80}, everySolver, damBreak}}; }

}  // namespace sluice::evaluate
