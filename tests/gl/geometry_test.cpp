// What the passes compute, against formulas.
#include <numbers>

#include "render_test.h"

namespace sluice::testing {
namespace {

using render::FloatPicture;
using render::Resource;

class Geometry : public RenderTest {
 protected:
  static Eigen::Vector2d slopeAt(int x, int y, core::ImageSize size, double fovDegrees) {
    const double pixel = 2 * std::tan(fovDegrees * std::numbers::pi / 360) / size.height;
    return {pixel * (x + 0.5 - 0.5 * size.width), pixel * (y + 0.5 - 0.5 * size.height)};
  }
};

TEST_F(Geometry, SphereHasItsExactDepth) {
  look.mutable_smoothing()->set_time(0);
  const core::ImageSize size{320, 240};
  // One as a point in a corner of a wide view, one as a rectangle, larger than a point may be.
  for (const auto& [centre, spacing] :
       {std::pair{Eigen::Vector3f(1.6F, 1.1F, -2.0F), 0.4}, {{0.1F, -0.1F, -2.0F}, 1.9}}) {
    render(cloud({centre}, spacing), alongZ(90), size);
    const FloatPicture surface = renderer.readBuffer(Resource::Surface);
    const double radius = 0.9 * spacing;
    const Eigen::Vector3d c(centre.x(), -centre.y(), -centre.z());
    int hits = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const Eigen::Vector2d w = slopeAt(x, y, size, 90);
        const Eigen::Vector3d ray(w.x(), w.y(), 1);
        const double b = ray.dot(c);
        const double discriminant = b * b - ray.squaredNorm() * (c.squaredNorm() - radius * radius);
        if (std::abs(discriminant) < 1e-4) continue;  // the outline itself may fall either way
        const double depth = (b - std::sqrt(std::max(discriminant, 0.0))) / ray.squaredNorm();
        const double expected = discriminant > 0 ? 1 / depth : 0;
        hits += discriminant > 0 ? 1 : 0;
        ASSERT_NEAR(surface.values[static_cast<std::size_t>(y * size.width + x)], expected, 2e-4 * expected)
            << x << ", " << y;
      }
    }
    EXPECT_GT(hits, 100);
  }
}

TEST_F(Geometry, ThicknessOfABallHoldsItsVolume) {
  // Far away and through a narrow lens the lines of sight are almost parallel, and the sum of thickness over area is
  // the volume: one particle, then a ball of many.
  std::vector<Eigen::Vector3f> ball;
  const float spacing = 0.1F;
  for (float z = -1; z <= 1; z += spacing) {
    for (float y = -1; y <= 1; y += spacing) {
      for (float x = -1; x <= 1; x += spacing) {
        if (x * x + y * y + z * z <= 1) ball.emplace_back(x, y, z - 60.0F);
      }
    }
  }
  const core::ImageSize size{400, 400};
  for (const int divisor : {1, 2, 4}) {
    look.mutable_thickness()->set_divisor(static_cast<std::uint32_t>(divisor));
    for (const auto& positions : {std::vector<Eigen::Vector3f>{{0, 0, -60}}, ball}) {
      const double particleSpacing = positions.size() == 1 ? 1.0 : spacing;
      render(cloud(positions, particleSpacing), alongZ(2.4F), size);
      const FloatPicture thickness = renderer.readBuffer(Resource::Thickness);
      double sum = 0;
      for (const float value : thickness.values) sum += value;
      const double pixel = 60 * 2 * std::tan(1.2 * std::numbers::pi / 180) / thickness.size.height;
      const double expected = static_cast<double>(positions.size()) * std::pow(particleSpacing, 3);
      EXPECT_NEAR(sum * pixel * pixel, expected, 0.02 * expected) << positions.size() << " at 1/" << divisor;
    }
  }
}

TEST_F(Geometry, EveryMethodSmoothsByTheSameTime) {
  // Flow of time T moves the apex of a sphere of radius R away by T/R, and so does a Gaussian of σ² = T.
  const core::ImageSize size{320, 240};
  const double radius = 0.9;
  const auto apexDepth = [&] {
    render(cloud({{0, 0, -3}}, 1.0), alongZ(), size);
    return 1.0 / renderer.readBuffer(Resource::Surface).values[static_cast<std::size_t>(120 * 320 + 160)];
  };
  v1::Smoothing& smoothing = *look.mutable_smoothing();
  smoothing.set_time(0);
  const double before = apexDepth();
  EXPECT_NEAR(before, 3 - radius, 1e-4);
  const double time = 0.01;
  smoothing.set_time(time);
  smoothing.mutable_implicit_curvature_flow()->set_steps(10);
  EXPECT_NEAR(apexDepth() - before, time / radius, 0.05 * time / radius) << "implicit";
  smoothing.mutable_curvature_flow()->set_max_iterations(4000);
  EXPECT_NEAR(apexDepth() - before, time / radius, 0.05 * time / radius) << "explicit";
  // The weight over depth differences shortens the bilateral filter's reach a little.
  smoothing.mutable_bilateral()->set_depth_deviation_in_radii(5);
  EXPECT_NEAR(apexDepth() - before, time / radius, 0.10 * time / radius) << "bilateral";
}

/// Root mean square angle between the normals shown, a byte for each component, and `expected` over a middle window,
/// degrees.
double normalError(const core::Frame& frame, const Eigen::Vector3d& expected) {
  double sum = 0;
  int count = 0;
  for (int y = frame.size.height / 3; y < 2 * frame.size.height / 3; ++y) {
    for (int x = frame.size.width / 3; x < 2 * frame.size.width / 3; ++x) {
      const std::uint8_t* p = &frame.pixels[static_cast<std::size_t>(4 * (y * frame.size.width + x))];
      const Eigen::Vector3d n = Eigen::Vector3d(p[0], p[1], p[2]) / 127.5 - Eigen::Vector3d::Ones();
      const double angle = std::acos(std::min(1.0, n.normalized().dot(expected))) * 180 / std::numbers::pi;
      sum += angle * angle;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST_F(Geometry, SmoothingTurnsABumpySlabIntoAPlane) {
  // The bounds leave half as much again as the errors known for these methods (plane, R = 0.8 d).
  look.mutable_splats()->set_radius_in_spacings(0.8);
  look.mutable_smoothing()->set_time(3);
  scene.mutable_view()->mutable_normals();
  const core::ImageSize size{256, 256};
  // At 2 m a spacing of 0.06 m is 9 pixels wide.
  const core::ParticleSnapshot particles = slab(2.0F, 1.2F, 0.06F);
  const Eigen::Vector3d facing(0, 0, 1);  // towards the eye
  look.mutable_smoothing()->mutable_implicit_curvature_flow();
  const double implicitError = normalError(render(particles, alongZ(), size), facing);
  EXPECT_LT(implicitError, 3.0);
  look.mutable_smoothing()->mutable_curvature_flow();
  const double explicitError = normalError(render(particles, alongZ(), size), facing);
  EXPECT_LT(explicitError, 6.0);
  look.mutable_smoothing()->mutable_bilateral();
  const double bilateralError = normalError(render(particles, alongZ(), size), facing);
  EXPECT_LT(bilateralError, 12.0);
  RecordProperty("implicit_degrees", std::to_string(implicitError));
  RecordProperty("explicit_degrees", std::to_string(explicitError));
  RecordProperty("bilateral_degrees", std::to_string(bilateralError));
  std::printf("normal error, degrees rms: implicit %.2f, explicit %.2f, bilateral %.2f\n", implicitError, explicitError,
              bilateralError);
}

}  // namespace
}  // namespace sluice::testing
