#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "shapes/surface.h"
#include "sluice/core/camera.h"
#include "sluice/core/particle_snapshot.h"

namespace sluice::evaluate {

/// A body of liquid whose surface is known exactly. Stands in front of `shapeCamera`, about 4 m away, and reaches
/// beyond the picture where it is not closed. Immutable.
class Shape : public Surface {
 public:
  virtual std::string_view name() const = 0;

  /// Distance from the surface, m; positive inside. Within a metre of it exact, or a lower bound where two surfaces
  /// cross.
  virtual double depthBelow(const Eigen::Vector3d& point) const = 0;

  /// The axes along which particles are laid out: those of a plane, or the world's.
  virtual Eigen::Isometry3d axes() const { return Eigen::Isometry3d::Identity(); }

  /// What particles fill, in the coordinates of `axes`.
  virtual Eigen::AlignedBox3d extent() const = 0;
};

// Lengths in spacings d = kShapeSpacing; see each file for the measures.
std::unique_ptr<Shape> makeTiltedPlane();
std::unique_ptr<Shape> makeFacingPlane();
std::unique_ptr<Shape> makeSphere();
std::unique_ptr<Shape> makeCylinder();
std::unique_ptr<Shape> makeTorus();
std::unique_ptr<Shape> makeWave();
std::unique_ptr<Shape> makeTwoSpheres();

/// All of the above.
std::vector<std::unique_ptr<Shape>> makeShapes();

/// d, m: 8 to 10 pixels from 4 to 3 m away at 256² and 45°.
constexpr double kShapeSpacing = 0.1;

/// At the origin, looking along −z, its target in the shapes' middle.
core::Camera shapeCamera();

/// Particles on a lattice along the shape's axes, each moved at random by up to a quarter of a spacing along each of
/// them, and kept where it lies deeper than a quarter: so the outermost layer of a plane stands half a spacing below
/// it on average, as in a liquid whose particles have the volume d³. What no picture
/// can show is left out. The same seed gives the same bits.
core::ParticleSnapshot fillShape(const Shape& shape, std::uint64_t seed);

}  // namespace sluice::evaluate
