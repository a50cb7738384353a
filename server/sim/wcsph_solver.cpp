#include "wcsph_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "sluice/core/check.h"

namespace sluice::sim {

namespace {

// c0 over the largest expected speed: density then varies by (v/c0)² = 1 %.
constexpr double kSoundOverSpeed = 10;

// Expected speed where nothing moves and nothing makes it move, m/s.
constexpr double kLeastSpeed = 0.1;

// Fluid that the continuity equation has thinned further than this has come apart: pressure would divide by 0.
constexpr float kLeastCompression = -0.9F;

struct PressureExtremes {
  float largestChange = 0;

  PressureExtremes& operator+=(const PressureExtremes& other) {
    largestChange = std::max(largestChange, other.largestChange);
    return *this;
  }
};

struct CompressionExtremes {
  float largest = 0;
  bool finite = true;

  CompressionExtremes& operator+=(const CompressionExtremes& other) {
    largest = std::max(largest, other.largest);
    finite = finite && other.finite;
    return *this;
  }
};

/// x^y. Whole exponents, which are the usual ones, by multiplication: many times faster than std::pow.
float raise(float x, double y) {
  const auto whole = static_cast<int>(y);
  if (whole != y) return std::pow(x, static_cast<float>(y));
  float power = 1;
  float square = x;
  for (int left = whole; left > 0; left /= 2, square *= square) power *= left % 2 == 1 ? square : 1.0F;
  return power;
}

bool wallsInReach(const StepContext& step) { return step.boundaryInReach || step.bodiesInReach; }

double densityRatioOf(const v1::Simulation& simulation) { return Mixture(simulation).densityRatio(); }

}  // namespace

WcsphSolver::WcsphSolver(const v1::Simulation& simulation)
    : settings_(simulation), densityRatio_(densityRatioOf(simulation)) {}

void WcsphSolver::update(const v1::Simulation& simulation) { settings_ = simulation; }

void WcsphSolver::reset(ParticleState& state, const Container& container) {
  state.compression.assign(state.size(), 0);
  fastestStart_ = 0;
  fallDown_ = fallUp_ = {};
  const auto note = [&](const std::array<double, 3>& place, double speed) {
    fastestStart_ = std::max(fastestStart_, speed);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fallDown_[axis] = std::max(fallDown_[axis], place[axis]);
      fallUp_[axis] = std::max(fallUp_[axis], container.size[axis] - place[axis]);
    }
  };
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Float4& x = state.position[i];
    const Float4& v = state.velocity[i];
    note({x.x, x.y, x.z}, std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z)));
  }
  for (const v1::Fluid& fluid : settings_.fluids()) {
    for (const v1::Emitter& emitter : fluid.emitters()) {
      const v1::Vec3& mouth = emitter.position();
      note({mouth.x() - container.origin[0], mouth.y() - container.origin[1], mouth.z() - container.origin[2]},
           emitter.speed());
    }
  }
}

double WcsphSolver::referenceSpeed() const {
  const v1::Wcsph& wcsph = settings_.wcsph();
  if (wcsph.speed_of_sound() > 0) return wcsph.speed_of_sound();
  const std::array<double, 3> g{settings_.gravity().x(), settings_.gravity().y(), settings_.gravity().z()};
  double fall = 0;  // Potential energy per mass, m²/s².
  for (std::size_t axis = 0; axis < 3; ++axis) {
    fall += g[axis] < 0 ? -g[axis] * fallDown_[axis] : g[axis] * fallUp_[axis];
  }
  return kSoundOverSpeed * std::max(kLeastSpeed, std::sqrt(fastestStart_ * fastestStart_ + 2 * fall));
}

double WcsphSolver::speedOfSound() const { return referenceSpeed() * std::sqrt(densityRatio_); }

void WcsphSolver::run(Stage stage, StepContext& step) {
  SLUICE_CHECK(stage == Stage::EquationOfState);
  mirrorGradient(step);
  applyPressure(step);
  integrateDensity(step);
}

void WcsphSolver::applyPressure(StepContext& step) {
  ParticleState& state = step.state;
  const NeighbourLists& lists = step.lists;
  const v1::Wcsph& wcsph = settings_.wcsph();
  impulse4_.resize(state.size());
  pushed_.resize(state.size());
  const double c = referenceSpeed();
  const auto stiffness = static_cast<float>(step.seconds * c * c / wcsph.exponent());
  const double exponent = wcsph.exponent();
  const float least = wcsph.negative_pressure() ? -std::numeric_limits<float>::infinity() : 0;
  step.team.forEachChunk(state.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      // A particle that has lost touch has lost its pressure too.
      if (lists.neighbours()[i] == 0) state.compression[i] = 0;
      const float density = 1.0F + state.compression[i];
      const float impulse = std::max(stiffness * (raise(density, exponent) - 1.0F), least);
      state.densityImpulse[i] = impulse;
      const float k = impulse / (density * density);
      impulse4_[i] = {k, k, k, k};
    }
  });
  const std::vector<Float4>& gradientSum = gradientWithMirror(step);
  const Mobility mobility = step.mixture.mobility(state.fluid);
  const auto extremes = step.team.sumOverChunks<PressureExtremes>(state.size(), [&](const Chunk& chunk) {
    lists.loops().applyImpulses(lists.chunk(chunk), mobility, impulse4_.data(), gradientSum.data(),
                                state.velocity.data(), pushed_.data());
    PressureExtremes part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const float x = pushed_[i].x - state.velocity[i].x;
      const float y = pushed_[i].y - state.velocity[i].y;
      const float z = pushed_[i].z - state.velocity[i].z;
      part.largestChange = std::max(part.largestChange, x * x + y * y + z * z);
    }
    return part;
  });
  state.velocity.swap(pushed_);
  // Walls answer with a mirrored pressure: twice the particle's.
  if (BodyCoupling* bodies = step.coupling()) bodies->push(impulse4_, 2, step.team);
  step.pressureAcceleration = std::sqrt(static_cast<double>(extremes.largestChange)) / step.seconds;
}

void WcsphSolver::mirrorGradient(const StepContext& step) {
  if (!wallsInReach(step)) return;
  const NeighbourLists& lists = step.lists;
  const std::size_t particles = step.state.size();
  ones_.assign(particles, {1, 1, 1, 1});
  gradient_.resize(particles);
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    lists.loops().weightedGradient(lists.chunk(chunk), ones_.data(), gradient_.data());
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& all = lists.gradientSum()[i];
      Float4& fluid = gradient_[i];
      fluid = {2 * all.x - fluid.x, 2 * all.y - fluid.y, 2 * all.z - fluid.z, 0};
    }
  });
}

const std::vector<Float4>& WcsphSolver::gradientWithMirror(const StepContext& step) const {
  return wallsInReach(step) ? gradient_ : step.lists.gradientSum();
}

void WcsphSolver::integrateDensity(StepContext& step) {
  ParticleState& state = step.state;
  const NeighbourLists& lists = step.lists;
  rate_.resize(state.size());
  const bool diffusive = settings_.wcsph().has_density_diffusion();
  if (diffusive) diffuseDensity(step);
  const auto seconds = static_cast<float>(step.seconds);
  const std::vector<Float4>& gradientSum = gradientWithMirror(step);
  step.team.forEachChunk(state.size(), [&](const Chunk& chunk) {
    lists.loops().densityRate(lists.chunk(chunk), state.velocity.data(), gradientSum.data(), rate_.data());
  });
  if (const BodyCoupling* bodies = step.coupling()) bodies->addRates(-2, rate_, step.team);
  const auto extremes = step.team.sumOverChunks<CompressionExtremes>(state.size(), [&](const Chunk& chunk) {
    CompressionExtremes part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const float rate = diffusive ? rate_[i] + diffusion_[i] : rate_[i];
      const float compression = state.compression[i] + seconds * rate;
      part.finite = part.finite && std::isfinite(compression);
      part.largest = std::max(part.largest, compression);
      state.compression[i] = std::max(compression, kLeastCompression);
    }
    return part;
  });
  const auto compression = static_cast<double>(extremes.largest);
  if (!extremes.finite) {
    step.trouble = "densities are no longer finite";
  } else if (compression > step.maxCompression) {
    std::ostringstream text;
    text << "a particle would be compressed by " << 100 * compression
         << " %, more than simulation.time_step.max_compression";
    step.trouble = text.str();
  }
}

void WcsphSolver::diffuseDensity(const StepContext& step) {
  const ParticleState& state = step.state;
  const double c = referenceSpeed();
  const std::vector<double>& restDensities = step.mixture.restDensities();
  const auto perMetre = [&](double g, std::size_t fluid) {
    return static_cast<float>(restDensities[fluid] / step.mixture.heaviest() * g / (c * c));
  };
  // Fluid that is stretched without pulling has no pressure either: its density must not spread.
  const float least = settings_.wcsph().negative_pressure() ? kLeastCompression : 0;
  std::vector<Float4>& places = impulse4_;
  step.team.forEachChunk(state.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const std::size_t fluid = state.fluid.empty() ? 0 : state.fluid[i];
      const Float4& x = state.position[i];
      const float hydrostatic = perMetre(settings_.gravity().x(), fluid) * x.x +
                                perMetre(settings_.gravity().y(), fluid) * x.y +
                                perMetre(settings_.gravity().z(), fluid) * x.z;
      places[i] = {x.x, x.y, x.z, std::max(state.compression[i], least) - hydrostatic};
    }
  });
  const double strength = settings_.wcsph().density_diffusion().strength();
  const PairStrength within =
      step.mixture.withinFluids(state.fluid, 2 * strength * step.discretisation.smoothingLength() * c);
  diffusion_.resize(state.size());
  step.team.forEachChunk(state.size(), [&](const Chunk& chunk) {
    step.lists.loops().diffuse(step.lists.chunk(chunk), step.lists.scale(), within, places.data(), diffusion_.data());
  });
}

std::uint64_t WcsphSolver::bytes() const {
  return (impulse4_.size() + pushed_.size() + ones_.size() + gradient_.size()) * sizeof(Float4) +
         (rate_.size() + diffusion_.size()) * sizeof(float);
}

}  // namespace sluice::sim
