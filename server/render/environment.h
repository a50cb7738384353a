#pragma once

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "frame_uniforms.h"
#include "sluice/imageio/image_file.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// Radiance that comes from a direction of length 1.
using Radiance = std::function<Eigen::Vector3f(const Eigen::Vector3f& direction)>;

/// A clear sky by day in a direction of length 1, without the sun's disc: whiter and brighter near the horizon, where
/// the way through the air is longest; a wide glow around the sun, the aureole, and its bright core; below the horizon,
/// ground.
Eigen::Vector3f skyRadiance(const Eigen::Vector3f& direction, const v1::Sky& sky, const v1::Sun& sun);

/// An equirectangular picture in a direction of length 1, interpolated: its middle lies along -z, its left edge along
/// +z, its top along +y. `turns` is added to the place along its width.
Eigen::Vector3f mapRadiance(const imageio::LinearImage& map, const Eigen::Vector3f& direction, float turns);

/// What a scene's environment sheds. `map` counts where it is a picture. A backdrop sheds nothing.
Radiance radianceOf(const v1::Scene& scene, const imageio::LinearImage& map);

/// All directions in one square picture: the octahedron |x|+|y|+|z| = 1, its upper half in the inner diamond, its lower
/// half folded outwards into the corners. Near equal in area everywhere, and found without trigonometry. `octahedral`
/// in shaders/environment.glsl is the inverse of `directionAt`.
struct EnvironmentPicture {
  int edge = 0;
  std::vector<float> values;  ///< 4·edge², red, green, blue and 1; row by row.
};

/// Direction of length 1 at a place of the picture, each coordinate 0 to 1.
Eigen::Vector3f directionAt(float u, float v);

/// Uses the OpenMP team of the calling thread; the same for any number of threads.
EnvironmentPicture makeEnvironmentPicture(const Radiance& radiance, int edge);

/// What the environment sheds on matte surfaces, as the first nine spherical harmonics of its radiance
/// [Ramamoorthi & Hanrahan 2001, An efficient representation for irradiance environment maps].
class AmbientLight {
 public:
  /// No light.
  AmbientLight() { coefficients_.fill(Eigen::Vector3f::Zero()); }
  /// Integrates over the sphere, in bands of equal solid angle.
  explicit AmbientLight(const Radiance& radiance);

  /// Radiance of a white matte surface with unit normal n: irradiance/π, at least 0.
  Eigen::Vector3f at(const Eigen::Vector3f& n) const;

  /// The same as the polynomials that shaders/environment.glsl evaluates, and the light on a level floor, which the sun
  /// that is packed already sheds as well.
  void pack(FrameUniforms& uniforms) const;

 private:
  std::array<Eigen::Vector3f, 9> coefficients_;  ///< L_lm·A_l/π in the order of harmonics().
};

}  // namespace sluice::render
