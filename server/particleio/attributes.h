#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sluice/particleio/particle_file.h"

namespace sluice::particleio {

enum class Attribute : std::uint8_t { Position, Velocity, Density, Id, Pressure, Fluid };

/// 3 for vectors, 1 for single numbers.
int componentsOf(Attribute attribute);

/// Where one number of a file belongs.
struct Target {
  Attribute attribute = Attribute::Position;
  int component = 0;

  bool operator==(const Target&) const = default;
};

/// The attribute that a whole array is named for: "velocity", "v", "Density", "pid".
std::optional<Attribute> attributeNamed(std::string_view name);

/// What a column or property of single numbers is named for: "x", "vy", "velocity_z", "Points:0", "density", "id".
std::optional<Target> targetNamed(std::string_view name);

/// Takes the numbers of a file in any order and gives the particles.
class ParticleBuilder {
 public:
  /// Takes the memory for `count` positions; the caller has checked that the file can hold that many.
  ParticleBuilder(std::string fileName, std::size_t count);

  /// Takes the memory for one attribute of every particle; its numbers are 0 until they are set.
  void enable(Attribute attribute);

  void set(std::size_t particle, Target target, double value);

  /// Throws core::InputError naming the first particle with a number that is not finite.
  ParticleFileData finish() &&;

 private:
  std::string fileName_;
  ParticleFileData particles_;
  bool idsAreWhole_ = true;
  bool fluidsAreWhole_ = true;
};

}  // namespace sluice::particleio
