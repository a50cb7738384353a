// Water that breaks loose in a tank and hits a box: Kleefsman, Fekken, Veldman, Iwanowski & Buchner 2005, second
// test of the SPHERIC community.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "solvers/run.h"

namespace sluice::evaluate {

namespace {

constexpr double kGravity = 9.81;
constexpr double kDensity = 1000;

// m: x from the wall behind the water, y up from the floor, z across.
constexpr std::array<double, 3> kTank{3.22, 1, 1};
constexpr double kWaterLength = 1.228;
constexpr double kWaterHeight = 0.55;
constexpr double kFront = 3.22 - 0.8245;  ///< The face of the box that the water comes to.
constexpr double kBack = 3.22 - 0.6635;
constexpr double kBoxHeight = 0.161;
constexpr double kBoxWidth = 0.403;
constexpr double kMiddle = 0.5;  ///< Plane of the gauges.
// Gauges of height: H2 before the box, H4 in the reservoir. (Sources number H1 and H3 in either order.)
constexpr double kH2 = 3.22 - 0.992;
constexpr double kH4 = 3.22 - 2.638;
// Gauges of pressure in the front face, m above the floor.
constexpr double kP1 = 0.021;
constexpr double kP3 = 0.101;

constexpr double kEnd = 1.9;         ///< s: before the wave comes back from the far wall to the reservoir.
constexpr double kSampling = 0.005;  ///< s, between looks at the particles.
constexpr double kPressureUnit = kDensity * kGravity * kWaterHeight;  ///< Pa.
/// Before this gauge reads anything, m: about a layer of the finest particles.
constexpr double kWet = 0.01;
/// Of ρ g H: when the pressure at P1 passes it, the water has come.
constexpr double kStruck = 0.3;

struct Sample {
  double time;   ///< s.
  double value;  ///< m, or multiples of ρ g H.
};

// Heights, from the experiment's record of a thousand samples a second (SPHERIC test 2, as published with Lethe's
// example "3D dam break").
constexpr std::array<Sample, 18> kHeightH2{{{0.358, 0.0101},
                                            {0.40, 0.0464},
                                            {0.45, 0.0771},
                                            {0.50, 0.0988},
                                            {0.70, 0.1314},
                                            {0.75, 0.1395},
                                            {0.80, 0.1467},
                                            {0.85, 0.1567},
                                            {1.10, 0.1855},
                                            {1.15, 0.1923},
                                            {1.20, 0.1954},
                                            {1.25, 0.2013},
                                            {1.30, 0.2079},
                                            {1.70, 0.3196},
                                            {1.75, 0.3214},
                                            {1.80, 0.3331},
                                            {1.85, 0.3033},
                                            {1.90, 0.2884}}};
constexpr std::array<Sample, 18> kHeightH4{{{0.30, 0.4861},
                                            {0.35, 0.4727},
                                            {0.40, 0.4595},
                                            {0.45, 0.4430},
                                            {0.50, 0.4261},
                                            {0.70, 0.3628},
                                            {0.75, 0.3474},
                                            {0.80, 0.3321},
                                            {0.85, 0.3173},
                                            {1.10, 0.2537},
                                            {1.15, 0.2431},
                                            {1.20, 0.2325},
                                            {1.25, 0.2231},
                                            {1.30, 0.2137},
                                            {1.70, 0.1589},
                                            {1.75, 0.1531},
                                            {1.80, 0.1474},
                                            {1.90, 0.1377}}};

// Pressures over ρ g H at times of √(H/g), as digitised for PySPH's example of the case.
constexpr std::array<Sample, 11> kPressureP1{{{1.575, 0.030},
                                              {1.672, 0.447},
                                              {1.678, 0.909},
                                              {1.684, 1.435},
                                              {1.711, 2.022},
                                              {1.778, 1.721},
                                              {1.948, 1.358},
                                              {2.308, 1.08},
                                              {2.733, 0.776},
                                              {3.581, 0.641},
                                              {4.854, 0.538}}};
constexpr std::array<Sample, 9> kPressureP3{{{1.565, 0.004},
                                             {1.778, 0.596},
                                             {1.816, 0.945},
                                             {1.934, 1.217},
                                             {2.079, 0.981},
                                             {2.531, 0.776},
                                             {3.265, 0.693},
                                             {4.115, 0.61},
                                             {5.223, 0.454}}};

/// Linear between samples; 0 before the first, the last value after the last.
double at(std::span<const Sample> course, double time) {
  const auto after = std::ranges::lower_bound(course, time, {}, &Sample::time);
  if (after == course.end()) return course.back().value;
  if (after == course.begin()) return after->time > time ? 0 : after->value;
  const Sample& before = *(after - 1);
  return before.value + (after->value - before.value) * (time - before.time) / (after->time - before.time);
}

/// Integral from `from` to `to` by trapezia of a two-hundredth each.
double integral(std::span<const Sample> course, double from, double to) {
  constexpr int kParts = 200;
  const double width = (to - from) / kParts;
  double sum = 0;
  for (int i = 0; i <= kParts; ++i) {
    sum += (i == 0 || i == kParts ? 0.5 : 1) * at(course, from + i * width);
  }
  return sum * width;
}

/// The first time at which a course passes `value`; NaN where it never does.
double firstPassing(std::span<const Sample> course, double value) {
  for (std::size_t i = 0; i < course.size(); ++i) {
    if (course[i].value < value) continue;
    if (i == 0) return course[0].time;
    const Sample& before = course[i - 1];
    return before.time + (course[i].time - before.time) * (value - before.value) / (course[i].value - before.value);
  }
  return std::nan("");
}

/// Fluid ends half a spacing from a particle, and particles come to rest one spacing from a wall: walls stand half a
/// spacing behind the faces of the experiment.
v1::Scene tank(double spacing) {
  const double margin = 0.5 * spacing;
  const auto set = [](v1::Vec3& vector, double x, double y, double z) {
    vector.set_x(x);
    vector.set_y(y);
    vector.set_z(z);
  };
  v1::Scene scene;
  v1::Simulation& simulation = *scene.mutable_simulation();
  simulation.set_particle_spacing(spacing);
  set(*simulation.mutable_gravity(), 0, -kGravity, 0);
  set(*simulation.mutable_container()->mutable_min(), -margin, -margin, -margin);
  set(*simulation.mutable_container()->mutable_max(), kTank[0] + margin, kTank[1] + margin, kTank[2] + margin);
  v1::Fluid& water = *simulation.add_fluids();
  water.set_viscosity(1e-6);
  v1::Block& block = *water.add_blocks();
  set(*block.mutable_first_particle(), margin, margin, margin);
  const auto count = [&](double length) { return static_cast<std::uint32_t>(std::lround(length / spacing)); };
  block.set_count_x(count(kWaterLength));
  block.set_count_y(count(kWaterHeight));
  block.set_count_z(count(kTank[2]));
  v1::Body& box = *scene.add_bodies();
  // From below the floor up.
  const double height = kBoxHeight + spacing;
  set(*box.mutable_position(), 0.5 * (kFront + kBack), kBoxHeight - margin - 0.5 * height, kMiddle);
  set(*box.mutable_box()->mutable_size(), kBack - kFront - spacing, height, kBoxWidth - spacing);
  return scene;
}

/// Water in a vertical shaft three spacings wide, per its cross-section: the length of a gauge that is wet.
double wetLength(const core::ParticleSnapshot& particles, double place) {
  constexpr double kWidth = 3;  // spacings
  const auto half = static_cast<float>(0.5 * kWidth * particles.spacing);
  int count = 0;
  for (const Eigen::Vector3f& x : particles.positions) {
    const bool inside =
        std::abs(x.x() - static_cast<float>(place)) < half && std::abs(x.z() - static_cast<float>(kMiddle)) < half;
    if (inside) ++count;
  }
  return count * particles.spacing / (kWidth * kWidth);
}

/// Mean pressure of the particles before the box's front near a height, over ρ g H; 0 where there are none.
double pressureOnFront(const core::ParticleSnapshot& particles, double height) {
  const double spacing = particles.spacing;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Eigen::Vector3d x = particles.positions[i].cast<double>();
    const bool before = x.x() < kFront && x.x() > kFront - 1.5 * spacing;
    if (!before || std::abs(x.y() - height) > 0.75 * spacing || std::abs(x.z() - kMiddle) > 2 * spacing) continue;
    sum += particles.pressures[i];
    ++count;
  }
  return count > 0 ? sum / count / kPressureUnit : 0;
}

/// √(Σ difference² / n) over the water's first height.
double rmsHeight(std::span<const Sample> course, std::span<const Sample> measured) {
  double sum = 0;
  for (const Sample& sample : measured) sum += std::pow(at(course, sample.time) - sample.value, 2);
  return std::sqrt(sum / static_cast<double>(measured.size())) / kWaterHeight;
}

std::vector<Finding> boxImpact(Run& run) {
  run.start(tank(1.0 / run.resolution()));
  const double unit = std::sqrt(kWaterHeight / kGravity);
  std::vector<Sample> h2;
  std::vector<Sample> h4;
  std::vector<Sample> p1;
  std::vector<Sample> p3;
  for (int i = 1; i * kSampling <= kEnd + 0.5 * kSampling; ++i) {
    if (!run.runTo(i * kSampling)) return {};
    const auto particles = run.particles();
    h2.push_back({run.time(), wetLength(*particles, kH2)});
    h4.push_back({run.time(), wetLength(*particles, kH4)});
    p1.push_back({run.time() / unit, pressureOnFront(*particles, kP1)});
    p3.push_back({run.time() / unit, pressureOnFront(*particles, kP3)});
  }
  const double arrival = firstPassing(h2, kWet) / firstPassing(kHeightH2, kWet);
  const double strike = firstPassing(p1, kStruck) / firstPassing(kPressureP1, kStruck);
  const auto impulse = [](std::span<const Sample> course, std::span<const Sample> measured) {
    // From before the water comes to where the shorter of the tables ends.
    return std::abs(integral(course, 1.5, 4.8) / integral(measured, 1.5, 4.8) - 1);
  };
  const std::string heights = "Kleefsman et al. 2005, gauge ";
  return {{"height at H2, rms over H, t < 1.9 s", rmsHeight(h2, kHeightH2), heights + "H2"},
          {"height at H4, rms over H, t < 1.9 s", rmsHeight(h4, kHeightH4), heights + "H4"},
          {"arrival at H2, relative", std::abs(arrival - 1), heights + "H2: 0.358 s"},
          {"arrival at the box, relative", std::abs(strike - 1), heights + "P1 at 0.3 rho g H: 0.388 s"},
          {"impulse on P1, relative, t < 1.14 s", impulse(p1, kPressureP1), heights + "P1"},
          {"impulse on P3, relative, t < 1.14 s", impulse(p3, kPressureP3), heights + "P3"}};
}

/// Sound ten times as fast as the water takes WCSPH steps so short that it would need most of an hour alone; at the
/// finest resolution DFSPH is what an hour allows.
bool isAffordable(const Method& method, int resolution) {
  constexpr int kFine = 50;
  return method.courant == 0 && isDefault(method) && (resolution < kFine || method.kind == SolverKind::Dfsph);
}

}  // namespace

std::vector<Case> boxImpactCases() { return {{"impact on a box", {}, {20, 40, 50}, isAffordable, boxImpact}}; }

}  // namespace sluice::evaluate
