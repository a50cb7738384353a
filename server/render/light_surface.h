#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "light_view.h"

namespace sluice::render {

/// How one liquid treats sunlight.
struct LitLiquid {
  Eigen::Array3f absorption = Eigen::Array3f::Zero();  ///< σ, 1/m.
  float refractiveIndex = 1;
  bool opaque = false;

  bool operator==(const LitLiquid& other) const {
    return (absorption == other.absorption).all() && refractiveIndex == other.refractiveIndex && opaque == other.opaque;
  }
};

/// Particles that stand in sunlight. Those below the floor cast nothing on it.
struct SunlitParticles {
  std::span<const Eigen::Vector3f> positions;
  std::span<const std::uint8_t> fluids;  ///< Which liquid each is of, or empty: all are of the first.
  float spacing = 1;                     ///< d, m.
  float floorHeight = 0;                 ///< m.
};

/// Where particles are that stand above the floor.
struct SunlitBounds {
  Eigen::AlignedBox2f across;  ///< Light space's x and y, m; empty where there are none.
  float highest = 0;           ///< Greatest world y, m.
};

/// The liquids as the sun sees them, cell by cell: the depth of the first surface, which liquid that is, and how much
/// of each stands along the light. Uses the OpenMP team of the calling thread; the result is the same for any number of
/// threads. Memory is kept from call to call.
class LightSurface {
 public:
  static SunlitBounds bounds(const SunlitParticles& particles, const LightAxes& axes);

  /// Draws the particles. The grid must leave kLightMargin around them.
  void draw(const SunlitParticles& particles, std::size_t liquids, const LightGrid& grid);

  /// Evens the front out over a Gaussian of standard deviation `deviation`, m, but not across steps of its depth.
  void smoothFront(const LightGrid& grid, float deviation, float spacing);

  /// Depth along the light, m; kNoLiquid where there is none.
  std::span<const float> front() const { return front_; }
  /// The liquid in front at each cell, or empty: there is but one.
  std::span<const std::uint8_t> frontLiquid() const { return frontLiquid_; }
  /// Length of the light's way in liquid k, m; smooth, and 0 along the border.
  std::span<const float> thickness(std::size_t liquid) const { return thickness_[liquid]; }

 private:
  /// What one liquid's particles make of the grid, some of them or all.
  struct Layer {
    std::vector<float> front;
    std::vector<float> thickness;
  };
  using Part = std::vector<Layer>;  ///< One for each liquid.

  static void drawPart(const SunlitParticles& particles, const LightGrid& grid, std::size_t first, std::size_t last,
                       Part& part);
  void join(std::size_t liquids, const LightGrid& grid);

  std::vector<Part> parts_;
  std::vector<float> front_;
  std::vector<std::uint8_t> frontLiquid_;
  std::vector<std::vector<float>> thickness_;
};

/// Free room around the particles' centres, particle spacings: thickness is smoothed into it.
inline constexpr float kLightMargin = 5.0F;

/// Two cells of the front that lie farther apart than this, particle spacings, are not of the same surface: cells are
/// half a spacing wide, so that a surface tilted by up to 76° against the light still is one.
inline constexpr float kStepOfFront = 2.0F;

}  // namespace sluice::render
