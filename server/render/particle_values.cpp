#include "particle_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sluice::render {

namespace {

/// Percentiles are of at most this many particles, evenly chosen: a range needs no more, and the time stays bounded.
constexpr std::size_t kSample = 8192;

/// 1st and 99th percentile.
ValueRange percentiles(const std::vector<float>& values) {
  const std::size_t step = values.size() / kSample + 1;
  std::vector<float> sample;
  for (std::size_t i = 0; i < values.size(); i += step) {
    if (std::isfinite(values[i])) sample.push_back(values[i]);
  }
  if (sample.empty()) return {};
  const auto at = [&](double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size() - 1));
    std::ranges::nth_element(sample, sample.begin() + place);
    return sample[static_cast<std::size_t>(place)];
  };
  const float least = at(0.01);
  return {least, at(0.99)};
}

}  // namespace

AttributeText textOf(v1::ColourMap::AttributeCase attribute) {
  switch (attribute) {
    case v1::ColourMap::kPressure:
      return {"Pressure", "Pa"};
    case v1::ColourMap::kDensityError:
      return {"Density error", "%"};
    case v1::ColourMap::kAge:
      return {"Age", "s"};
    case v1::ColourMap::kParticleId:
      return {"Particle", ""};
    case v1::ColourMap::kSpeed:
    case v1::ColourMap::ATTRIBUTE_NOT_SET:
      break;
  }
  return {"Speed", "m/s"};
}

std::string_view missingFor(v1::ColourMap::AttributeCase attribute, const core::ParticleSnapshot& particles) {
  switch (attribute) {
    case v1::ColourMap::kPressure:
      return particles.pressures.empty() ? "the source gives no pressures" : "";
    case v1::ColourMap::kDensityError:
      return particles.densities.empty() ? "the source gives no densities" : "";
    case v1::ColourMap::kAge:
      return particles.ages.empty() ? "the source gives no ages" : "";
    case v1::ColourMap::kParticleId:
      return particles.ids.empty() ? "the source gives no numbers of particles" : "";
    case v1::ColourMap::kSpeed:
    case v1::ColourMap::ATTRIBUTE_NOT_SET:
      break;
  }
  return particles.velocities.empty() ? "the source gives no velocities" : "";
}

std::vector<float> valuesOf(v1::ColourMap::AttributeCase attribute, const core::ParticleSnapshot& particles) {
  if (!missingFor(attribute, particles).empty()) return {};
  std::vector<float> values(particles.size());
  const auto percent = static_cast<float>(100.0 / particles.restDensity);
  switch (attribute) {
    case v1::ColourMap::kPressure:
      return particles.pressures;
    case v1::ColourMap::kDensityError:
      std::ranges::transform(particles.densities, values.begin(),
                             [&](float density) { return density * percent - 100.0F; });
      break;
    case v1::ColourMap::kAge:
      return particles.ages;
    case v1::ColourMap::kParticleId:
      std::ranges::transform(particles.ids, values.begin(), [](std::uint32_t id) { return static_cast<float>(id); });
      break;
    case v1::ColourMap::kSpeed:
    case v1::ColourMap::ATTRIBUTE_NOT_SET:
      std::ranges::transform(particles.velocities, values.begin(), [](const Eigen::Vector3f& v) { return v.norm(); });
      break;
  }
  return values;
}

std::vector<float> velocitiesOf(const v1::VelocityMap& map, const core::ParticleSnapshot& particles) {
  std::vector<float> values(particles.velocities.size());
  const Eigen::Vector3f direction =
      Eigen::Vector3d(map.direction().x(), map.direction().y(), map.direction().z()).cast<float>();
  const float length = direction.norm();
  const Eigen::Vector3f along = length > 0.0F ? Eigen::Vector3f(direction / length) : Eigen::Vector3f::Zero();
  std::ranges::transform(particles.velocities, values.begin(),
                         [&](const Eigen::Vector3f& v) { return length > 0.0F ? v.dot(along) : v.norm(); });
  return values;
}

double niceStep(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  // A hair below each step, so that 0.1 + 0.2 is still "not above 0.3".
  const double mantissa = value / power * (1.0 - 1e-9);
  return power * (mantissa <= 1.0 ? 1.0 : mantissa <= 2.0 ? 2.0 : mantissa <= 5.0 ? 5.0 : 10.0);
}

ValueRange robustRange(const std::vector<float>& values, bool aboutZero, const ValueRange* previous) {
  ValueRange measured = percentiles(values);
  if (aboutZero && measured.least < 0.0F && measured.most > 0.0F) {
    const float reach = std::max(-measured.least, measured.most);
    measured = {-reach, reach};
  }
  if (previous != nullptr && previous->least <= measured.least && measured.most <= previous->most &&
      measured.width() >= 0.6F * previous->width()) {
    return *previous;
  }
  // All of one value: around it, as wide as it is large, so that there is something to read off.
  const float size = std::max(std::abs(measured.least), std::abs(measured.most));
  const double width = measured.width() > 1e-5F * size ? measured.width() : size > 0.0F ? size : 1.0;
  const double step = niceStep(width / 8.0);
  const auto least = static_cast<float>(step * std::floor(measured.least / step));
  const auto most = static_cast<float>(step * std::ceil(measured.most / step));
  return {least, most > least ? most : least + static_cast<float>(step)};
}

}  // namespace sluice::render
