#include "sluice/render/pick_fluid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace sluice::render {

namespace {

/// A particle near enough to the ray to matter.
struct Near {
  float along;   // Of its foot on the ray, from the origin, m.
  float apart2;  // Squared distance from the ray, m².
  std::uint32_t index;
};

/// Field values above this are fluid: the plane through the outer faces of the cells of a lattice's last layer.
constexpr double kSurface = 0.5;

/// Samples of the field per spacing; crossings between them are found by bisection.
constexpr double kStepsPerSpacing = 4;
constexpr int kBisections = 12;

class Line {
 public:
  Line(const core::ParticleSnapshot& particles, const core::Ray& ray)
      : particles_(particles), ray_(ray), spacing_(particles.spacing), support_(2 * particles.spacing) {
    const auto reach2 = static_cast<float>(support_ * support_);
    for (std::uint32_t i = 0; i < particles.size(); ++i) {
      const Eigen::Vector3f offset = particles.positions[i] - ray.origin;
      const float along = offset.dot(ray.direction);
      const float apart2 = offset.squaredNorm() - along * along;
      if (apart2 < reach2 && along > 0) near_.push_back({along, apart2, i});
    }
    std::sort(near_.begin(), near_.end(), [](const Near& a, const Near& b) { return a.along < b.along; });
  }

  std::optional<PickedFluid> pick() const {
    if (near_.empty()) return std::nullopt;
    const double step = spacing_ / kStepsPerSpacing;
    const double begin = std::max(near_.front().along - support_, 0.0);
    const double end = near_.back().along + support_;
    double first = -1;
    double thickness = 0;
    double entered = field(begin) > kSurface ? begin : -1;
    if (entered >= 0) first = entered;
    for (double t = begin; t < end; t += step) {
      const bool inside = field(t + step) > kSurface;
      if (inside == (entered >= 0)) continue;
      const double crossing = bisect(t, t + step, inside);
      if (inside) {
        entered = crossing;
        if (first < 0) first = crossing;
      } else {
        thickness += crossing - entered;
        entered = -1;
      }
    }
    return first >= 0 ? describe(first, thickness) : nearestSphere();
  }

 private:
  // W · d³ with Wendland's C2 kernel, Wendland 1995.
  double weight(const Near& particle, double t) const {
    const double along = particle.along - t;
    const double r2 = particle.apart2 + along * along;
    if (r2 >= support_ * support_) return 0;
    const double q = std::sqrt(r2) / support_;
    const double rest = (1 - q) * (1 - q);
    const double ratio = spacing_ / support_;
    return 21 / (2 * std::numbers::pi) * ratio * ratio * ratio * rest * rest * (4 * q + 1);
  }

  template <class Visit>
  void visit(double t, Visit&& visitor) const {
    auto particle = std::lower_bound(near_.begin(), near_.end(), t - support_,
                                     [](const Near& a, double value) { return a.along < value; });
    for (; particle != near_.end() && particle->along < t + support_; ++particle) {
      const double w = weight(*particle, t);
      if (w > 0) visitor(*particle, w);
    }
  }

  double field(double t) const {
    double sum = 0;
    visit(t, [&](const Near&, double w) { sum += w; });
    return sum;
  }

  double bisect(double outer, double inner, bool entering) const {
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (outer + inner);
      ((field(middle) > kSurface) == entering ? inner : outer) = middle;
    }
    return 0.5 * (outer + inner);
  }

  PickedFluid describe(double t, double thickness) const {
    PickedFluid picked;
    picked.position = ray_.origin + static_cast<float>(t) * ray_.direction;
    picked.depth = t * ray_.direction.dot(ray_.axis);
    picked.thickness = thickness;
    picked.velocity.setZero();
    double sum = 0;
    double greatest = -1;
    visit(t, [&](const Near& particle, double w) {
      const std::uint32_t i = particle.index;
      sum += w;
      if (i < particles_.velocities.size()) picked.velocity += static_cast<float>(w) * particles_.velocities[i];
      if (i < particles_.densities.size()) picked.density += w * particles_.densities[i];
      if (w <= greatest) return;
      greatest = w;
      picked.fluid = i < particles_.fluids.size() ? particles_.fluids[i] : 0;
    });
    if (sum > 0) {
      picked.velocity /= static_cast<float>(sum);
      picked.density /= sum;
    }
    return picked;
  }

  std::optional<PickedFluid> nearestSphere() const {
    const double radius2 = 0.25 * spacing_ * spacing_;
    double thickness = 0;
    double first = -1;
    for (const Near& particle : near_) {
      if (particle.apart2 >= radius2) continue;
      const double half = std::sqrt(radius2 - particle.apart2);
      if (first < 0) first = particle.along - half;
      thickness += 2 * half;
    }
    if (first < 0) return std::nullopt;
    return describe(first, thickness);
  }

  const core::ParticleSnapshot& particles_;
  const core::Ray& ray_;
  double spacing_;
  double support_;
  std::vector<Near> near_;
};

}  // namespace

std::optional<PickedFluid> pickFluid(const core::ParticleSnapshot& particles, const core::Ray& ray) {
  return Line(particles, ray).pick();
}

}  // namespace sluice::render
