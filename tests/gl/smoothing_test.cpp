// What every smoothing method has to keep to, whatever it is: each case runs for each member of Smoothing.method.
#include <algorithm>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "render_test.h"

namespace sluice::testing {
namespace {

using google::protobuf::FieldDescriptor;
using render::FloatPicture;
using render::Resource;

const google::protobuf::OneofDescriptor& methods() { return *v1::Smoothing::descriptor()->FindOneofByName("method"); }

std::vector<std::string> methodsBut(const std::vector<std::string>& left) {
  std::vector<std::string> names;
  for (int i = 0; i < methods().field_count(); ++i) {
    const std::string name = methods().field(i)->name();
    if (std::ranges::find(left, name) == left.end()) names.push_back(name);
  }
  return names;
}

class SmoothingTest : public RenderTest, public ::testing::WithParamInterface<std::string> {
 protected:
  SmoothingTest() { choose(GetParam()); }

  void choose(const std::string& method) {
    v1::Smoothing& smoothing = *look.mutable_smoothing();
    const FieldDescriptor* const field = v1::Smoothing::descriptor()->FindFieldByName(method);
    google::protobuf::Message* const message = smoothing.GetReflection()->MutableMessage(&smoothing, field);
    const FieldDescriptor* const most = message->GetDescriptor()->FindFieldByName("max_iterations");
    // So that T alone says how much is smoothed.
    if (most != nullptr) message->GetReflection()->SetUInt32(message, most, 10000);
    scene::complete(smoothing);
  }

  FloatPicture smooth(const FloatPicture& surface, double spacing, float fovDegrees = 45) {
    return renderer.smooth(surface, look, spacing, alongZ(fovDegrees));
  }

  /// What the look makes of particles.
  FloatPicture surfaceOf(const core::ParticleSnapshot& particles, const core::Camera& camera, core::ImageSize size) {
    render(particles, camera, size);
    return renderer.readBuffer(Resource::Surface);
  }
};

#define FOR_METHODS(suite, names)                                    \
  INSTANTIATE_TEST_SUITE_P(Every, suite, ::testing::ValuesIn(names), \
                           [](const auto& method) { return std::string(method.param); })

std::size_t at(core::ImageSize size, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
}

double slopeAt(int pixel, int count, int height, double fovDegrees = 45) {
  return 2 * std::tan(fovDegrees * std::numbers::pi / 360) / height * (pixel + 0.5 - 0.5 * count);
}

/// A surface of given depth over the view slopes, 0 for none.
template <class Depth>
FloatPicture pictureOf(core::ImageSize size, const Depth& depth) {
  FloatPicture picture{size, {}};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double z = depth(slopeAt(x, size.width, size.height), slopeAt(y, size.height, size.height));
      picture.values.push_back(z > 0 ? static_cast<float>(1 / z) : 0.0F);
    }
  }
  return picture;
}

/// z = 2 + 0.8·x − 0.5·y.
double tiltedPlane(double wx, double wy) { return 2 / (1 - 0.8 * wx + 0.5 * wy); }

/// Jittered particles in a ball of ten spacings radius, d = 0.1 m, `distance` m away.
core::ParticleSnapshot bumpyBall(float distance) {
  core::ParticleSnapshot snapshot;
  snapshot.spacing = 0.1;
  std::mt19937 random(11);
  const auto jitter = [&] { return 0.05F * (static_cast<float>(random() >> 8) / static_cast<float>(1U << 24) - 0.5F); };
  for (int k = -10; k <= 10; ++k) {
    for (int j = -10; j <= 10; ++j) {
      for (int i = -10; i <= 10; ++i) {
        const Eigen::Vector3f p(0.1F * i + jitter(), 0.1F * j + jitter(), 0.1F * k + jitter());
        if (p.norm() <= 0.95F) snapshot.positions.emplace_back(p.x(), p.y(), p.z() - distance);
      }
    }
  }
  snapshot.bounds = core::boundsOf(snapshot.positions);
  return snapshot;
}

/// Inverse depth between four pixels; 0 where one of them holds no liquid.
double interpolated(const FloatPicture& picture, double x, double y) {
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  if (left < 0 || top < 0 || left + 1 >= picture.size.width || top + 1 >= picture.size.height) return 0;
  double sum = 0;
  for (const int dy : {0, 1}) {
    for (const int dx : {0, 1}) {
      const double q = picture.values[at(picture.size, left + dx, top + dy)];
      if (q <= 0) return 0;
      sum += q * (dx == 1 ? x - left : 1 - x + left) * (dy == 1 ? y - top : 1 - y + top);
    }
  }
  return sum;
}

// --- Planes ---

/// Methods that work in inverse depth, where planes are affine.
class PlaneTest : public SmoothingTest {};
FOR_METHODS(PlaneTest, methodsBut({"binomial", "curvature_flow_vanderlaan2009"}));

TEST_P(PlaneTest, StaysWhereWindowsAreWhole) {
  const core::ImageSize size{160, 120};
  const FloatPicture plane = pictureOf(size, tiltedPlane);
  // σ = 0.05 m is up to 9 pixels wide, 3 σ fewer than 28; what reaches past the picture's border is not symmetric.
  look.mutable_smoothing()->set_time(1);
  const FloatPicture smoothed = smooth(plane, 0.05);
  for (int y = 28; y < size.height - 28; ++y) {
    for (int x = 28; x < size.width - 28; ++x) {
      const float q = plane.values[at(size, x, y)];
      ASSERT_NEAR(smoothed.values[at(size, x, y)], q, 1e-5F * q) << x << ", " << y;
    }
  }
}

/// Methods that know where a surface ends.
class PlaneEdgeTest : public SmoothingTest {};
FOR_METHODS(PlaneEdgeTest,
            (std::vector<std::string>{"curvature_flow", "implicit_curvature_flow", "rkl_curvature_flow", "plane_fit"}));

TEST_P(PlaneEdgeTest, StaysUpToItsSilhouette) {
  const core::ImageSize size{160, 120};
  const FloatPicture disc =
      pictureOf(size, [](double wx, double wy) { return std::hypot(wx, wy) < 0.3 ? tiltedPlane(wx, wy) : 0; });
  look.mutable_smoothing()->set_time(1);
  const FloatPicture smoothed = smooth(disc, 0.05);
  for (std::size_t i = 0; i < disc.values.size(); ++i) {
    ASSERT_NEAR(smoothed.values[i], disc.values[i], 3e-5F * disc.values[i]) << i;
  }
}

// --- Every method ---

class SmoothingMethodTest : public SmoothingTest {};
FOR_METHODS(SmoothingMethodTest, methodsBut({}));

TEST_P(SmoothingMethodTest, NoiseShrinks) {
  const core::ImageSize size{160, 120};
  std::mt19937 random(3);
  const auto noisy = [&](double wx, double wy) {
    // A tenth of a spacing up and down, on a slope that is small: a bilateral filter's weights follow the pixel itself,
    // which keeps a share of its noise where depth changes within the kernel.
    return 2 / (1 - 0.1 * wx) + 0.004 * (static_cast<double>(random() >> 8) / (1U << 24) - 0.5) + 0 * wy;
  };
  const FloatPicture surface = pictureOf(size, noisy);
  const FloatPicture smoothed = smooth(surface, 0.02);
  const auto roughness = [&](const FloatPicture& picture) {
    double sum = 0;
    int count = 0;
    for (int y = 40; y < 80; ++y) {
      for (int x = 40; x < 120; ++x) {
        const double z = 1 / static_cast<double>(picture.values[at(size, x, y)]);
        sum += std::pow(z - 2 / (1 - 0.1 * slopeAt(x, size.width, size.height)), 2);
        ++count;
      }
    }
    return std::sqrt(sum / count);
  };
  const double before = roughness(surface);
  const double after = roughness(smoothed);
  RecordProperty("left", std::to_string(after / before));
  std::printf("%s leaves %.3f of the noise\n", GetParam().c_str(), after / before);
  EXPECT_LT(after, 0.2 * before);
}

TEST_P(SmoothingMethodTest, NoTimeChangesNothing) {
  const core::ImageSize size{100, 75};
  const FloatPicture surface = pictureOf(size, [](double wx, double wy) {
    return std::hypot(wx, wy) < 0.3 ? 2 + 0.01 * std::sin(100 * wx) * std::cos(80 * wy) : 0;
  });
  look.mutable_smoothing()->set_time(1e-9);
  const FloatPicture smoothed = smooth(surface, 0.05);
  for (std::size_t i = 0; i < surface.values.size(); ++i) {
    ASSERT_NEAR(smoothed.values[i], surface.values[i], 1e-6F * surface.values[i]) << i;
  }
}

TEST_P(SmoothingMethodTest, TimeMeansTheSame) {
  // Flow of time T moves the apex of a sphere of radius R away by T/R, and so does a Gaussian of σ² = T.
  const core::ImageSize size{320, 240};
  const double radius = 0.9;
  const FloatPicture sphere = pictureOf(size, [&](double wx, double wy) {
    const double a = 1 + wx * wx + wy * wy;
    const double d = 9 - a * (9 - radius * radius);
    return d > 0 ? (3 - std::sqrt(d)) / a : 0;
  });
  const double time = 0.01;
  const double spacing = 0.15;
  look.mutable_smoothing()->set_time(time / (spacing * spacing));
  const auto apex = [&](const FloatPicture& picture) { return 1.0 / picture.values[at(size, 160, 120)]; };
  const double moved = apex(smooth(sphere, spacing)) - apex(sphere);
  std::printf("%s moves the apex by %.3f of T/R\n", GetParam().c_str(), moved * radius / time);
  // Kernels end at 3 σ, where 3 to 5 % of the variance are missing; weights over depth take a little more.
  EXPECT_NEAR(moved, time / radius, 0.12 * time / radius);
}

TEST_P(SmoothingMethodTest, SilhouettesStay) {
  const core::ParticleSnapshot particles = columnAndSheet(8000);
  const core::ImageSize size{200, 150};
  look.mutable_smoothing()->set_time(0);
  const FloatPicture raw = surfaceOf(particles, columnAndSheetCamera(), size);
  look.mutable_smoothing()->set_time(1);
  if (look.smoothing().has_implicit_curvature_flow()) {
    // It closes notches of the outline on purpose.
    look.mutable_smoothing()->mutable_implicit_curvature_flow()->set_close_gaps_in_spacings(0);
  }
  const FloatPicture smoothed = surfaceOf(particles, columnAndSheetCamera(), size);
  int liquid = 0;
  int lost = 0;
  for (std::size_t i = 0; i < raw.values.size(); ++i) {
    ASSERT_TRUE(std::isfinite(smoothed.values[i])) << i;
    ASSERT_GE(smoothed.values[i], 0.0F) << i;
    ASSERT_TRUE(raw.values[i] > 0 || smoothed.values[i] == 0.0F) << "liquid invented at " << i;
    liquid += raw.values[i] > 0 ? 1 : 0;
    lost += raw.values[i] > 0 && smoothed.values[i] <= 0 ? 1 : 0;
  }
  EXPECT_GT(liquid, 3000);
  if (GetParam() == "binomial") {
    // With its silhouette map it gives up what its filter has seen background from, but not all.
    EXPECT_GT(lost, liquid / 20);
    EXPECT_LT(lost, 3 * liquid / 4);
    look.mutable_smoothing()->mutable_binomial()->set_silhouette_map(false);
    const FloatPicture whole = surfaceOf(particles, columnAndSheetCamera(), size);
    for (std::size_t i = 0; i < raw.values.size(); ++i) ASSERT_EQ(whole.values[i] > 0, raw.values[i] > 0) << i;
  } else {
    EXPECT_EQ(lost, 0);
  }
}

TEST_P(SmoothingMethodTest, HardDepthsStayWithinThemselves) {
  // From 1 mm to 1,000 km from pixel to pixel, with holes: what comes out lies between what went in, or within the
  // factor of two by which a step may go wrong.
  const core::ImageSize size{64, 48};
  std::mt19937 random(5);
  const FloatPicture surface = pictureOf(size, [&](double, double) {
    const double share = static_cast<double>(random() >> 8) / (1U << 24);
    return share < 0.1 ? 0.0 : std::pow(10.0, 9 * (share - 0.1) / 0.9 - 3);
  });
  if (look.smoothing().has_implicit_curvature_flow()) {
    // Which puts liquid into holes on purpose.
    look.mutable_smoothing()->mutable_implicit_curvature_flow()->set_close_gaps_in_spacings(0);
  }
  for (const double time : {0.5, 50.0}) {
    look.mutable_smoothing()->set_time(time);
    const FloatPicture smoothed = smooth(surface, 0.05);
    const bool mayErode = look.smoothing().has_binomial();
    for (std::size_t i = 0; i < surface.values.size(); ++i) {
      const float q = smoothed.values[i];
      if (surface.values[i] == 0.0F || (mayErode && q == 0.0F)) {
        ASSERT_EQ(q, 0.0F) << i;
        continue;
      }
      ASSERT_GE(q, 0.5F * 1e-6F) << i;
      ASSERT_LE(q, 2.0F * 1e3F) << i;
    }
  }
}

TEST_P(SmoothingMethodTest, TurningThePictureChangesNothing) {
  // By 45° about the line of sight.
  const core::ParticleSnapshot ball = bumpyBall(5);
  const core::ImageSize size{256, 256};
  core::Camera upright = alongZ(30);
  core::Camera turned = upright;
  const double angle = std::numbers::pi / 4;
  turned.up = {static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)), 0};
  const auto difference = [&] {
    const FloatPicture a = surfaceOf(ball, upright, size);
    const FloatPicture b = surfaceOf(ball, turned, size);
    double sum = 0;
    int count = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const double u = x + 0.5 - 128;
        const double v = y + 0.5 - 128;
        // The ball is 95 pixels in radius; near its limb a pixel is many depths.
        if (std::hypot(u, v) > 65) continue;
        const double other = interpolated(b, u * std::cos(angle) + v * std::sin(angle) + 127.5,
                                          v * std::cos(angle) - u * std::sin(angle) + 127.5);
        const double q = a.values[at(size, x, y)];
        if (q <= 0 || other <= 0) continue;
        sum += std::pow(1 / q - 1 / other, 2);
        ++count;
      }
    }
    EXPECT_GT(count, 4000);
    return std::sqrt(sum / count) / ball.spacing;
  };
  look.mutable_smoothing()->set_time(0);
  const double raw = difference();
  look.mutable_smoothing()->set_time(2);
  const double smoothed = difference();
  std::printf("%s: turned by 45° it differs by %.4f d, the splats themselves by %.4f d\n", GetParam().c_str(), smoothed,
              raw);
  // Splitting the bilateral filter into two directions is an approximation, which shows.
  EXPECT_LT(smoothed, GetParam() == "bilateral" ? 0.05 : 0.03);
}

TEST_P(SmoothingMethodTest, DistantLiquidIsNoSmoother) {
  // Twice as far in a picture of twice the edge, through a lens so long that lines of sight are all but parallel.
  const auto surfaceFrom = [&](float distance, int edge) {
    return surfaceOf(bumpyBall(distance), alongZ(0.75F), {edge, edge});
  };
  look.mutable_smoothing()->set_time(2);
  const FloatPicture near = surfaceFrom(200, 240);
  const FloatPicture far = surfaceFrom(400, 480);
  double sum = 0;
  int count = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 240; ++x) {
      const double qNear = near.values[at(near.size, x, y)];
      const double qFar = far.values[at(far.size, x + 120, y + 120)];
      // The ball is 92 pixels in radius; near its limb a pixel is many depths.
      if (qNear <= 0 || qFar <= 0 || std::hypot(x - 119.5, y - 119.5) > 65) continue;
      sum += std::pow((1 / qNear - 200) - (1 / qFar - 400), 2);
      ++count;
    }
  }
  EXPECT_GT(count, 3000);
  const double difference = std::sqrt(sum / count) / 0.1;
  std::printf("%s: from twice as far it differs by %.4f d\n", GetParam().c_str(), difference);
  EXPECT_LT(difference, 0.03);
}

// --- Edge-aware methods ---

class EdgeAwareTest : public SmoothingTest {};
FOR_METHODS(EdgeAwareTest, methodsBut({"binomial", "gaussian"}));

TEST_P(EdgeAwareTest, KeepsSilhouettesInsideTheLiquid) {
  // A nearer plane before a farther one, 20 spacings away: no pixel leaves its own. The narrow-range filter bends edges
  // back on purpose, by less than μ, one splat radius, each time that it runs along both axes, which is three times.
  const core::ImageSize size{160, 120};
  const auto depth = [](double wx, double wy) { return wx + 0.3 * wy < 0.02 ? 2.0 : 3.0; };
  const FloatPicture step = pictureOf(size, depth);
  const double spacing = 0.05;
  const double radius = look.splats().radius_in_spacings() * spacing;
  const double tolerance = GetParam() == "narrow_range" ? 3 * radius : 0.001 * radius;
  const FloatPicture smoothed = smooth(step, spacing);
  for (std::size_t i = 0; i < step.values.size(); ++i) {
    ASSERT_NEAR(1 / smoothed.values[i], 1 / step.values[i], tolerance) << i;
  }
}

// --- Flow on the CPU ---

class NativeFlowTest : public SmoothingTest {};
FOR_METHODS(NativeFlowTest,
            (std::vector<std::string>{"curvature_flow", "rkl_curvature_flow", "implicit_curvature_flow"}));

TEST_P(NativeFlowTest, EqualsTheShaders) {
  const core::ImageSize size{320, 240};
  const core::Camera camera = columnAndSheetCamera();
  const core::ParticleSnapshot particles = columnAndSheet(8000);
  look.mutable_smoothing()->set_time(0);
  const FloatPicture raw = surfaceOf(particles, camera, size);
  look.mutable_smoothing()->set_time(2);
  // An odd number.
  if (look.smoothing().has_curvature_flow()) look.mutable_smoothing()->mutable_curvature_flow()->set_max_iterations(15);
  const FloatPicture native = smoothOn({.software = true}, raw, camera, particles.spacing);
  const FloatPicture shaded = smoothOn({.software = false}, raw, camera, particles.spacing);
  int differing = 0;
  int changed = 0;
  for (std::size_t i = 0; i < raw.values.size(); ++i) {
    differing += std::abs(native.values[i] - shaded.values[i]) > 1e-4F * raw.values[i] ? 1 : 0;
    changed += std::abs(native.values[i] - raw.values[i]) > 1e-3F * raw.values[i] ? 1 : 0;
  }
  EXPECT_GT(changed, 2000);
  // A neighbour that is just within the edge for one may be just beyond for the other.
  EXPECT_LT(differing, 40);
  std::printf("%s: %d pixels differ by more than 1e-4\n", GetParam().c_str(), differing);
}

}  // namespace
}  // namespace sluice::testing
