#include "attributes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>

#include "sluice/core/input_error.h"

namespace sluice::particleio {

namespace {

std::string lowerCase(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

template <std::size_t n>
bool contains(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr std::array<std::string_view, 5> kPositionNames{"p", "pos", "position", "point", "points"};
constexpr std::array<std::string_view, 4> kVelocityNames{"v", "vel", "velocity", "velocities"};
constexpr std::array<std::string_view, 3> kDensityNames{"density", "densities", "rho"};
// SPlisHSPlasH, Houdini and partio; splashsurf and ParaView.
constexpr std::array<std::string_view, 5> kIdNames{"id", "ids", "pid", "particleid", "particle_id"};
constexpr std::array<std::string_view, 2> kPressureNames{"pressure", "pressures"};
constexpr std::array<std::string_view, 2> kFluidNames{"fluid", "fluids"};

int axisOf(char letter) {
  switch (letter) {
    case 'x':
    case '0':
      return 0;
    case 'y':
    case '1':
      return 1;
    case 'z':
    case '2':
      return 2;
    default:
      return -1;
  }
}

/// A whole number that fits into `Number`, or none.
template <class Number>
std::optional<Number> whole(double value) {
  if (!(value >= 0 && value <= std::numeric_limits<Number>::max()) || value != std::floor(value)) return std::nullopt;
  return static_cast<Number>(value);
}

[[noreturn]] void refuse(const std::string& fileName, std::size_t particle, const char* what,
                         const Eigen::Vector3f& value) {
  std::ostringstream text;
  text << what << " of particle " << particle << " is (" << value.x() << ", " << value.y() << ", " << value.z()
       << "); every component must be finite";
  throw core::InputError(fileName, "", text.str());
}

}  // namespace

int componentsOf(Attribute attribute) {
  return attribute == Attribute::Position || attribute == Attribute::Velocity ? 3 : 1;
}

std::optional<Attribute> attributeNamed(std::string_view name) {
  const std::string lower = lowerCase(name);
  if (contains(kPositionNames, lower)) return Attribute::Position;
  if (contains(kVelocityNames, lower)) return Attribute::Velocity;
  if (contains(kDensityNames, lower)) return Attribute::Density;
  if (contains(kIdNames, lower)) return Attribute::Id;
  if (contains(kPressureNames, lower)) return Attribute::Pressure;
  if (contains(kFluidNames, lower)) return Attribute::Fluid;
  return std::nullopt;
}

std::optional<Target> targetNamed(std::string_view name) {
  const std::string lower = lowerCase(name);
  if (const auto attribute = attributeNamed(lower); attribute && componentsOf(*attribute) == 1) {
    return Target{*attribute, 0};
  }
  if (lower.empty()) return std::nullopt;
  const int axis = axisOf(lower.back());
  if (axis < 0) return std::nullopt;
  std::string_view stem = std::string_view(lower).substr(0, lower.size() - 1);
  if (stem.empty()) {
    // A column named "0" is no coordinate.
    return std::isalpha(static_cast<unsigned char>(lower.back())) != 0
               ? std::optional(Target{Attribute::Position, axis})
               : std::nullopt;
  }
  // velocity_x, velocity.x, velocity:0 (ParaView), velocityx
  if (std::string_view("_.:").find(stem.back()) != std::string_view::npos) stem.remove_suffix(1);
  if (contains(kPositionNames, stem)) return Target{Attribute::Position, axis};
  if (contains(kVelocityNames, stem)) return Target{Attribute::Velocity, axis};
  return std::nullopt;
}

ParticleBuilder::ParticleBuilder(std::string fileName, std::size_t count) : fileName_(std::move(fileName)) {
  particles_.positions.assign(count, Eigen::Vector3f::Zero());
}

void ParticleBuilder::enable(Attribute attribute) {
  const std::size_t count = particles_.size();
  switch (attribute) {
    case Attribute::Position:
      break;
    case Attribute::Velocity:
      particles_.velocities.assign(count, Eigen::Vector3f::Zero());
      break;
    case Attribute::Density:
      particles_.densities.assign(count, 0.0F);
      break;
    case Attribute::Id:
      particles_.ids.assign(count, 0);
      break;
    case Attribute::Pressure:
      particles_.pressures.assign(count, 0.0F);
      break;
    case Attribute::Fluid:
      particles_.fluids.assign(count, 0);
      break;
  }
}

void ParticleBuilder::set(std::size_t particle, Target target, double value) {
  switch (target.attribute) {
    case Attribute::Position:
      particles_.positions[particle][target.component] = static_cast<float>(value);
      break;
    case Attribute::Velocity:
      particles_.velocities[particle][target.component] = static_cast<float>(value);
      break;
    case Attribute::Density:
      particles_.densities[particle] = static_cast<float>(value);
      break;
    case Attribute::Id:
      if (const auto id = whole<std::uint32_t>(value)) {
        particles_.ids[particle] = *id;
      } else {
        idsAreWhole_ = false;
      }
      break;
    case Attribute::Pressure:
      particles_.pressures[particle] = static_cast<float>(value);
      break;
    case Attribute::Fluid:
      if (const auto fluid = whole<std::uint8_t>(value)) {
        particles_.fluids[particle] = *fluid;
      } else {
        fluidsAreWhole_ = false;
      }
      break;
  }
}

ParticleFileData ParticleBuilder::finish() && {
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    if (!particles_.positions[i].allFinite()) refuse(fileName_, i, "the position", particles_.positions[i]);
  }
  for (std::size_t i = 0; i < particles_.velocities.size(); ++i) {
    if (!particles_.velocities[i].allFinite()) refuse(fileName_, i, "the velocity", particles_.velocities[i]);
  }
  for (std::size_t i = 0; i < particles_.densities.size(); ++i) {
    if (std::isfinite(particles_.densities[i])) continue;
    throw core::InputError(fileName_, "", "the density of particle " + std::to_string(i) + " is not finite");
  }
  if (!idsAreWhole_) particles_.ids.clear();
  if (!fluidsAreWhole_) particles_.fluids.clear();
  const auto finite = [](float value) { return std::isfinite(value); };
  if (!std::ranges::all_of(particles_.pressures, finite)) particles_.pressures.clear();
  return std::move(particles_);
}

}  // namespace sluice::particleio
