#include "viscosity_weiler2018.h"

#include <cmath>
#include <sstream>

namespace sluice::sim {

namespace {

// Where the iterations run out, a residual of more than this share of the start's is no solution.
constexpr double kSaneResidual = 0.1;

struct Sum {
  double value = 0;

  Sum& operator+=(const Sum& other) {
    value += other.value;
    return *this;
  }
};

/// Two inner products of one pass.
struct Products {
  double alignment = 0;       ///< Σ m r·M⁻¹r.
  double residualSquare = 0;  ///< Σ m r·r.

  Products& operator+=(const Products& other) {
    alignment += other.alignment;
    residualSquare += other.residualSquare;
    return *this;
  }
};

struct MomentumSum {
  double mass = 0;
  std::array<double, 3> momentum{};

  MomentumSum& operator+=(const MomentumSum& other) {
    mass += other.mass;
    for (std::size_t axis = 0; axis < 3; ++axis) momentum[axis] += other.momentum[axis];
    return *this;
  }
};

double dot(const Float4& a, const Float4& b) {
  return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y + static_cast<double>(a.z) * b.z;
}

/// a + factor b.
Float4 addScaled(const Float4& a, float factor, const Float4& b) {
  return {a.x + factor * b.x, a.y + factor * b.y, a.z + factor * b.z, 0};
}

PairStrength negated(PairStrength strength) {
  for (auto& row : strength.strength) {
    for (float& value : row) value = -value;
  }
  return strength;
}

}  // namespace

void ImplicitViscosity::apply(const v1::ImplicitViscosity& settings, StepContext& step) {
  mass_.clear();
  for (const double density : step.mixture.restDensities()) {
    mass_.push_back(static_cast<float>(density / step.mixture.heaviest()));
  }
  const PairStrength friction =
      step.mixture.friction(step.state.fluid, step.discretisation.viscosityScale * step.seconds);
  // Against the friction: the loop's v_i + Σ … then is v_i - dt a_i, the product with the system's matrix.
  const PairStrength resistance = negated(friction);
  invertBlocks(friction, step);
  double alignment = start(resistance, step);
  const double startSquare = residualSquare_;
  const double goal = settings.residual() * settings.residual() * startSquare;
  std::uint32_t iterations = 0;
  while (residualSquare_ > goal && iterations < settings.max_iterations()) {
    alignment = iterate(resistance, alignment, step);
    ++iterations;
  }
  keepMomentum(step);
  step.statistics.viscosityIterations = iterations;
  const double left = startSquare > 0 ? std::sqrt(residualSquare_ / startSquare) : 0;
  if (left > kSaneResidual || !std::isfinite(left)) {
    std::ostringstream text;
    text << "the viscosity solve left a residual of " << left << " after " << iterations << " iterations";
    step.trouble = text.str();
  }
}

void ImplicitViscosity::invertBlocks(const PairStrength& friction, const StepContext& step) {
  const std::size_t particles = step.state.size();
  columns_.resize(3 * particles);
  inverse_.resize(particles);
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    step.lists.loops().viscosityBlocks(step.lists.chunk(chunk), step.lists.scale(), friction,
                                       step.state.position.data(), columns_.data());
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      // 1 - Σ …, symmetric but for the rounding of the gradients. Its eigenvalues are at least 1.
      const Float4* c = &columns_[3 * i];
      const float xx = 1 - c[0].x;
      const float yy = 1 - c[1].y;
      const float zz = 1 - c[2].z;
      const float xy = -0.5F * (c[0].y + c[1].x);
      const float yz = -0.5F * (c[1].z + c[2].y);
      const float zx = -0.5F * (c[2].x + c[0].z);
      const float minorX = yy * zz - yz * yz;
      const float minorXy = yz * zx - xy * zz;
      const float minorZx = xy * yz - yy * zx;
      const float inverse = 1 / (xx * minorX + xy * minorXy + zx * minorZx);
      inverse_[i] = {{minorX * inverse, (xx * zz - zx * zx) * inverse, (xx * yy - xy * xy) * inverse},
                     {minorXy * inverse, (xy * zx - xx * yz) * inverse, minorZx * inverse}};
    }
  });
}

Float4 ImplicitViscosity::precondition(std::size_t i) const {
  const Float4& r = residual_[i];
  const auto& [diagonal, beside] = inverse_[i];
  return {diagonal[0] * r.x + beside[0] * r.y + beside[2] * r.z, beside[0] * r.x + diagonal[1] * r.y + beside[1] * r.z,
          beside[2] * r.x + beside[1] * r.y + diagonal[2] * r.z, 0};
}

double ImplicitViscosity::start(const PairStrength& resistance, const StepContext& step) {
  const std::size_t particles = step.state.size();
  for (std::vector<Float4>* values : {&residual_, &direction_, &image_, &conditioned_}) values->resize(particles);
  const auto products = step.team.sumOverChunks<Products>(particles, [&](const Chunk& chunk) {
    step.lists.loops().applyViscosity(step.lists.chunk(chunk), step.lists.scale(), resistance,
                                      step.state.position.data(), step.state.velocity.data(), image_.data());
    Products part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      residual_[i] = addScaled(step.state.velocity[i], -1, image_[i]);
      direction_[i] = precondition(i);
      const double mass = mass_[step.state.fluid.empty() ? 0 : step.state.fluid[i]];
      part.alignment += mass * dot(residual_[i], direction_[i]);
      part.residualSquare += mass * dot(residual_[i], residual_[i]);
    }
    return part;
  });
  residualSquare_ = products.residualSquare;
  return products.alignment;
}

double ImplicitViscosity::iterate(const PairStrength& resistance, double alignment, const StepContext& step) {
  const std::size_t particles = step.state.size();
  const auto mass = [&](std::size_t i) -> double { return mass_[step.state.fluid.empty() ? 0 : step.state.fluid[i]]; };
  const auto curvature = step.team.sumOverChunks<Sum>(particles, [&](const Chunk& chunk) {
    step.lists.loops().applyViscosity(step.lists.chunk(chunk), step.lists.scale(), resistance,
                                      step.state.position.data(), direction_.data(), image_.data());
    Sum part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) part.value += mass(i) * dot(direction_[i], image_[i]);
    return part;
  });
  const auto length = static_cast<float>(alignment / curvature.value);
  const auto products = step.team.sumOverChunks<Products>(particles, [&](const Chunk& chunk) {
    Products part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      step.state.velocity[i] = addScaled(step.state.velocity[i], length, direction_[i]);
      residual_[i] = addScaled(residual_[i], -length, image_[i]);
      conditioned_[i] = precondition(i);
      part.alignment += mass(i) * dot(residual_[i], conditioned_[i]);
      part.residualSquare += mass(i) * dot(residual_[i], residual_[i]);
    }
    return part;
  });
  const auto share = static_cast<float>(products.alignment / alignment);
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      direction_[i] = addScaled(conditioned_[i], share, direction_[i]);
    }
  });
  residualSquare_ = products.residualSquare;
  return products.alignment;
}

void ImplicitViscosity::keepMomentum(const StepContext& step) {
  const auto total = step.team.sumOverChunks<MomentumSum>(step.state.size(), [&](const Chunk& chunk) {
    MomentumSum part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const double mass = mass_[step.state.fluid.empty() ? 0 : step.state.fluid[i]];
      part.mass += mass;
      part.momentum[0] += mass * residual_[i].x;
      part.momentum[1] += mass * residual_[i].y;
      part.momentum[2] += mass * residual_[i].z;
    }
    return part;
  });
  const auto mean = [&](std::size_t axis) { return static_cast<float>(total.momentum[axis] / total.mass); };
  const Float4 left{mean(0), mean(1), mean(2), 0};
  step.team.forEachChunk(step.state.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      step.state.velocity[i] = addScaled(step.state.velocity[i], 1, left);
    }
  });
}

std::uint64_t ImplicitViscosity::bytes() const {
  return (residual_.size() + direction_.size() + image_.size() + conditioned_.size() + columns_.size()) *
             sizeof(Float4) +
         inverse_.size() * sizeof(Block);
}

}  // namespace sluice::sim
