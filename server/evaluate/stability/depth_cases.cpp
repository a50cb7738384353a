#include "stability/depth_cases.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "metrics/sight.h"
#include "shapes/ball.h"

namespace sluice::evaluate {

namespace {

constexpr core::ImageSize kSize{128, 128};
constexpr double kDepth = 4;    // m
constexpr double kBump = 0.05;  // m: half a spacing, the bumps of splats
constexpr double kJump = 1e6;   // ratio of depths

/// An eye depth for every pixel, m; 0 for no liquid.
using DepthAt = std::function<double(int x, int y)>;

DepthCase draw(std::string name, const DepthAt& depthAt) {
  DepthCase result{std::move(name), {kSize, {}}};
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double z = depthAt(x, y);
      result.surface.values.push_back(z > 0 ? static_cast<float>(1 / z) : 0.0F);
    }
  }
  return result;
}

/// Bumps as large as those of splats, so that every case has something to smooth.
double bumpy(int x, int y) { return kDepth + kBump * std::sin(1.3 * x) * std::cos(1.7 * y); }

double within(bool inside, int x, int y) { return inside ? bumpy(x, y) : 0.0; }

/// Depth of a plane through the picture's middle whose normal leans `degrees` away from the eye.
double planeDepth(const Sight& sight, double degrees, int x, int y) {
  const double slope = std::tan(degrees * std::numbers::pi / 180);
  const double fall = 1 - slope * sight.slope(x, y).x();
  return fall > 1e-3 ? kDepth / fall : 0.0;  // beyond lies its horizon
}

}  // namespace

core::Camera depthCaseCamera() { return {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 45.0F}; }

std::vector<DepthCase> depthCases() {
  const Sight sight = makeSight(depthCaseCamera(), kSize);
  std::mt19937 random(11);
  const auto coin = [&random](double chance) { return static_cast<double>(random()) < chance * 0x1p32; };
  const auto centre = [](int x, int y) { return std::hypot(x - 63.5, y - 63.5); };
  const Ball ball{{0, 0, -kDepth}, 1.0};

  std::vector<DepthCase> cases;
  cases.push_back(draw("all background", [](int, int) { return 0.0; }));
  cases.push_back(draw("all liquid", bumpy));
  cases.push_back(draw("one pixel", [](int x, int y) { return within(x == 64 && y == 64, x, y); }));
  cases.push_back(draw("one-pixel masks", [](int x, int y) { return within(x % 3 == 0 && y % 3 == 0, x, y); }));
  cases.push_back(draw("checkerboard mask", [](int x, int y) { return within((x + y) % 2 == 0, x, y); }));
  cases.push_back(draw("random mask", [&](int x, int y) { return within(coin(0.5), x, y); }));
  cases.push_back(draw("one-pixel rows", [](int x, int y) { return within(y % 2 == 0, x, y); }));
  cases.push_back(draw("one-pixel columns", [](int x, int y) { return within(x % 2 == 0, x, y); }));
  cases.push_back(draw("depth jump of 1e6 across", [](int x, int y) { return bumpy(x, y) * (x < 64 ? 1 : kJump); }));
  cases.push_back(
      draw("depth jumps of 1e6 everywhere", [&](int x, int y) { return bumpy(x, y) * (coin(0.5) ? 1 : kJump); }));
  cases.push_back(draw("depths from 1e-3 m to 1e6 m", [](int x, int) { return 1e-3 * std::pow(1e9, x / 127.0); }));
  cases.push_back(draw("thin bridges", [&](int x, int y) {
    const bool ends = std::abs(x - 64) > 34;
    return within(ends || y % 16 == 8 || std::abs(x - y) == 1, x, y);
  }));
  cases.push_back(draw("concave outline", [&](int x, int y) {
    const double angle = std::atan2(y - 63.5, x - 63.5);
    return within(centre(x, y) < 36 + 24 * std::cos(5 * angle) && centre(x, y) > 6, x, y);
  }));
  cases.push_back(draw("notch", [](int x, int y) { return within(x < 80 || std::abs(y - 64) > 2, x, y); }));
  cases.push_back(
      draw("borders alone", [](int x, int y) { return within(x < 2 || y < 2 || x > 125 || y > 125, x, y); }));
  cases.push_back(
      draw("corners alone", [](int x, int y) { return within((x < 3 || x > 124) && (y < 3 || y > 124), x, y); }));
  cases.push_back(draw("plane seen at 80 degrees", [&](int x, int y) { return planeDepth(sight, 80, x, y); }));
  cases.push_back(draw("bumpy plane seen at 80 degrees", [&](int x, int y) {
    return planeDepth(sight, 80, x, y) * (1 + 0.01 * std::sin(1.3 * x) * std::cos(1.7 * y));
  }));
  cases.push_back(draw("ball", [&](int x, int y) {
    const Eigen::Vector3d line = sight.line(x, y);
    const auto hit = ball.trace(sight.eye, sight.toWorld * line.normalized());
    return hit ? hit->distance / line.norm() : 0.0;
  }));
  cases.push_back({"noise", noisyLevel(kSize, 0.02)});
  cases.push_back({"noise of 90 % of the depth", noisyLevel(kSize, 0.9)});
  return cases;
}

render::FloatPicture noisyLevel(core::ImageSize size, double amplitude) {
  std::mt19937 random(5);
  render::FloatPicture picture{size, {}};
  for (int i = 0; i < size.width * size.height; ++i) {
    const double noise = amplitude * (2 * static_cast<double>(random()) * 0x1p-32 - 1);
    picture.values.push_back(static_cast<float>(1 / (kDepth * (1 + noise))));
  }
  return picture;
}

}  // namespace sluice::evaluate
