#include "environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pack.h"

namespace sluice::render {

namespace {

using Eigen::Vector3f;

Vector3f toVector(const v1::Vec3& v) { return Eigen::Vector3d(v.x(), v.y(), v.z()).cast<float>(); }

constexpr float kHarmonic0 = 0.282095F;   // 1/(2√π)
constexpr float kHarmonic1 = 0.488603F;   // √(3/4π)
constexpr float kHarmonic2 = 1.092548F;   // √(15/4π)
constexpr float kHarmonic20 = 0.315392F;  // √(5/16π)
constexpr float kHarmonic22 = 0.546274F;  // √(15/16π)

/// Real spherical harmonics of degree 0, 1 (y, z, x) and 2 (xy, yz, 3zz − 1, zx, xx − yy).
std::array<float, 9> harmonics(const Vector3f& n) {
  const float x = n.x();
  const float y = n.y();
  const float z = n.z();
  return {kHarmonic0,
          kHarmonic1 * y,
          kHarmonic1 * z,
          kHarmonic1 * x,
          kHarmonic2 * x * y,
          kHarmonic2 * y * z,
          kHarmonic20 * (3 * z * z - 1),
          kHarmonic2 * z * x,
          kHarmonic22 * (x * x - y * y)};
}

/// Â_l/π: what a clamped cosine lets through of each degree, Eq. (8) of Ramamoorthi & Hanrahan.
constexpr std::array<float, 9> kCosine{1.0F, 2.0F / 3, 2.0F / 3, 2.0F / 3, 0.25F, 0.25F, 0.25F, 0.25F, 0.25F};

}  // namespace

Vector3f skyRadiance(const Vector3f& direction, const v1::Sky& sky, const v1::Sun& sun) {
  const Vector3f zenith = toVector(sky.zenith());
  const Vector3f horizon = toVector(sky.horizon());
  // The square root keeps the bright band near the horizon narrow, as the thin air overhead does.
  const float height = std::sqrt(std::clamp(direction.y(), 0.0F, 1.0F));
  const Vector3f air = horizon + height * (zenith - horizon);
  // Haze scatters sunlight forwards: a wide glow and a bright core.
  const float towards = std::max(direction.dot(sunDirection(sun)), 0.0F);
  const float glow = 0.26F * std::pow(towards, 8.0F) + 0.6F * std::pow(towards, 96.0F);
  const Vector3f warm(1.0F, 0.86F, 0.66F);
  // Below the horizon, where there is no floor, the ground is dimmer than the band above it.
  const float depth = std::clamp(direction.y() / -0.35F, 0.0F, 1.0F);
  const float ground = depth * depth * (3.0F - 2.0F * depth);
  return (1.0F - ground) * (air + glow * static_cast<float>(sun.strength()) * warm) + ground * 0.55F * horizon;
}

Vector3f mapRadiance(const imageio::LinearImage& map, const Vector3f& direction, float turns) {
  const int width = map.size.width;
  const int height = map.size.height;
  const float across = 0.5F + std::atan2(direction.x(), -direction.z()) / (2 * std::numbers::pi_v<float>)+turns;
  const float x = (across - std::floor(across)) * static_cast<float>(width) - 0.5F;
  const float y =
      std::acos(std::clamp(direction.y(), -1.0F, 1.0F)) / std::numbers::pi_v<float> * static_cast<float>(height) - 0.5F;
  const auto texel = [&](int column, int row) {
    const int wrapped = (column % width + width) % width;
    const int clamped = std::clamp(row, 0, height - 1);
    return Vector3f(map.values.data() + 3 * (static_cast<std::ptrdiff_t>(clamped) * width + wrapped));
  };
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  const float u = x - static_cast<float>(left);
  const float v = y - static_cast<float>(top);
  return (1 - v) * ((1 - u) * texel(left, top) + u * texel(left + 1, top)) +
         v * ((1 - u) * texel(left, top + 1) + u * texel(left + 1, top + 1));
}

AmbientLight::AmbientLight(const Radiance& radiance) : AmbientLight() {
  constexpr int kBands = 64;
  constexpr int kAround = 128;
  constexpr float kSolidAngle = 4 * std::numbers::pi_v<float> / (kBands * kAround);
  for (int i = 0; i < kBands; ++i) {
    const float y = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / kBands;
    const float ring = std::sqrt(1.0F - y * y);
    for (int j = 0; j < kAround; ++j) {
      const float turn = 2 * std::numbers::pi_v<float> * (static_cast<float>(j) + 0.5F) / kAround;
      const Vector3f direction(ring * std::cos(turn), y, ring * std::sin(turn));
      const Vector3f light = kSolidAngle * radiance(direction);
      const std::array<float, 9> basis = harmonics(direction);
      for (std::size_t k = 0; k < basis.size(); ++k) coefficients_[k] += kCosine[k] * basis[k] * light;
    }
  }
}

Vector3f AmbientLight::at(const Vector3f& n) const {
  const std::array<float, 9> basis = harmonics(n);
  Vector3f light = Vector3f::Zero();
  for (std::size_t k = 0; k < basis.size(); ++k) light += basis[k] * coefficients_[k];
  return light.cwiseMax(0.0F);
}

void AmbientLight::pack(FrameUniforms& uniforms) const {
  const auto& c = coefficients_;
  const std::array first{&uniforms.ambientRed, &uniforms.ambientGreen, &uniforms.ambientBlue};
  const std::array second{&uniforms.ambientRed2, &uniforms.ambientGreen2, &uniforms.ambientBlue2};
  for (int i = 0; i < 3; ++i) {
    const auto channel = static_cast<std::size_t>(i);
    *first[channel] = {kHarmonic1 * c[3][i], kHarmonic1 * c[1][i], kHarmonic1 * c[2][i],
                       kHarmonic0 * c[0][i] - kHarmonic20 * c[6][i]};
    *second[channel] = {kHarmonic2 * c[4][i], kHarmonic2 * c[5][i], 3 * kHarmonic20 * c[6][i], kHarmonic2 * c[7][i]};
    uniforms.ambientPlane[channel] = kHarmonic22 * c[8][i];
  }
  const auto& sun = uniforms.sunlight;
  const Vector3f fromSun = std::max(uniforms.sun[1], 0.0F) * Vector3f(sun[0], sun[1], sun[2]);
  const Vector3f light = fromSun + at(Vector3f::UnitY());
  const Vector3f luminance(0.2126F, 0.7152F, 0.0722F);
  uniforms.floorLight = render::pack(light, fromSun.dot(luminance) / std::max(light.dot(luminance), 1e-6F));
}

Radiance radianceOf(const v1::Scene& scene, const imageio::LinearImage& map) {
  const v1::Background& background = scene.background();
  switch (background.environment_case()) {
    case v1::Background::kBackdrop:
      return [](const Vector3f&) -> Vector3f { return Vector3f::Zero(); };
    case v1::Background::kUniform:
      return [radiance = toVector(background.uniform().radiance())](const Vector3f&) { return radiance; };
    case v1::Background::kEnvironmentMap: {
      const auto strength = static_cast<float>(background.environment_map().strength());
      const auto turns = static_cast<float>(background.environment_map().turn_degrees() / 360);
      return [&map, strength, turns](const Vector3f& direction) -> Vector3f {
        return strength * mapRadiance(map, direction, turns);
      };
    }
    default:
      return [sky = background.sky(), sun = scene.lighting().sun()](const Vector3f& direction) {
        return skyRadiance(direction, sky, sun);
      };
  }
}

Vector3f directionAt(float u, float v) {
  Eigen::Vector2f p(2 * u - 1, 2 * v - 1);
  const float y = 1 - std::abs(p.x()) - std::abs(p.y());
  if (y < 0) {
    p = {std::copysign(1 - std::abs(p.y()), p.x()), std::copysign(1 - std::abs(p.x()), p.y())};
  }
  return Vector3f(p.x(), y, p.y()).normalized();
}

EnvironmentPicture makeEnvironmentPicture(const Radiance& radiance, int edge) {
  // What half floats hold, with room for the sum of several.
  constexpr float kBrightest = 3e4F;
  const auto side = static_cast<std::size_t>(edge);
  EnvironmentPicture picture{edge, std::vector<float>(4 * side * side)};
#pragma omp parallel for schedule(static)
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      const auto place = [&](int i) { return (static_cast<float>(i) + 0.5F) / static_cast<float>(edge); };
      const Vector3f light = radiance(directionAt(place(x), place(y))).cwiseMin(kBrightest);
      float* const texel =
          picture.values.data() + 4 * (static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x));
      texel[0] = light.x();
      texel[1] = light.y();
      texel[2] = light.z();
      texel[3] = 1;
    }
  }
  return picture;
}

}  // namespace sluice::render
