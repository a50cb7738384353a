#include "sluice/sources/column_and_sheet.h"

#include <cmath>
#include <random>

#include "sluice/core/check.h"
#include "source_plan.h"

namespace sluice::sources {

namespace {

double spacingOf(std::size_t n) { return std::cbrt(0.55 / static_cast<double>(n)); }

/// Lattice sites at 0.5, 1.5, … spacings that lie within an extent; at least one.
std::size_t sitesWithin(double extent, double spacing) {
  return static_cast<std::size_t>(std::max(1.0, std::floor(extent / spacing + 0.5)));
}

class CloudSource : public core::ParticleSource {
 public:
  explicit CloudSource(const v1::Scene& scene) {
    const std::size_t count = scene.column_and_sheet().particles();
    particles_.positions = columnAndSheet(count, scene.seed());
    spacing_ = spacingOf(count);
  }

  bool advance() override { return false; }
  double time() const override { return 0; }
  void reset() override {}

  std::unique_ptr<core::ParticleSnapshot> snapshot() const override {
    auto snapshot = std::make_unique<core::ParticleSnapshot>();
    snapshot->spacing = spacing_;
    snapshot->positions = particles_.positions;
    snapshot->bounds = core::boundsOf(particles_.positions);
    return snapshot;
  }

  void update(const v1::Scene&) override {}  // none of its fields is live

  core::Plan plan() const override { return planOfStored(particles_); }

 private:
  particleio::ParticleFileData particles_;
  double spacing_ = 0;
};

}  // namespace

std::vector<Eigen::Vector3f> columnAndSheet(std::size_t n, std::uint64_t seed) {
  std::vector<Eigen::Vector3f> positions;
  if (n == 0) return positions;
  positions.reserve(n);
  const double spacing = spacingOf(n);

  std::mt19937_64 random(seed);
  // Not std::uniform_real_distribution, whose values differ between libraries. 53 bits fill a double's mantissa.
  const auto jitter = [&] { return 0.15 * spacing * (static_cast<double>(random() >> 11U) * 0x1p-52 - 1); };

  // Adds layers of a lattice from the floor up, `layers` of them or until there are n particles.
  const auto fill = [&](double left, double right, std::size_t layers) {
    const std::size_t countX = sitesWithin(right - left, spacing);
    const std::size_t countZ = sitesWithin(1.0, spacing);
    const auto site = [&](std::size_t i) { return (static_cast<double>(i) + 0.5) * spacing; };
    for (std::size_t y = 0; y < layers; ++y) {
      for (std::size_t z = 0; z < countZ; ++z) {
        for (std::size_t x = 0; x < countX; ++x) {
          if (positions.size() == n) return;
          // One statement each: the order of the random numbers is part of the scene.
          const double px = left + site(x) + jitter();
          const double py = site(y) + jitter();
          const double pz = site(z) + jitter();
          positions.push_back(Eigen::Vector3d(px, py, pz).cast<float>());
        }
      }
    }
  };
  fill(0.5, 2.0, sitesWithin(0.1, spacing));
  fill(0.0, 0.5, n);
  return positions;
}

std::unique_ptr<core::ParticleSource> openColumnAndSheet(const v1::Scene& scene) {
  SLUICE_CHECK(scene.has_column_and_sheet());
  return std::make_unique<CloudSource>(scene);
}

}  // namespace sluice::sources
