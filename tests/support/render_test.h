#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "column_and_sheet.h"
#include "sluice/gl/context.h"
#include "sluice/gl/debug_messages.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/scene/scene.h"

namespace sluice::testing {

/// A renderer on a context that reports errors, every one of which fails the test.
class RenderTest : public ::testing::Test {
 protected:
  RenderTest() { scene::complete(scene); }

  void TearDown() override {
    for (const std::string& message : messages_.take()) ADD_FAILURE() << "GL: " << message;
  }

  core::Frame render(const core::ParticleSnapshot& particles, const core::Camera& camera, core::ImageSize size) {
    return renderer.render(particles, scene, camera, size);
  }

  /// As with --set. From then on use `scene` alone: `look`, `background` and `sun` may refer to what is gone.
  void assign(const std::vector<std::string>& assignments) {
    scene.mutable_column_and_sheet();  // so that it is valid; tests bring particles of their own
    scene::assign(scene, assignments);
  }

  static core::ParticleSnapshot cloud(std::vector<Eigen::Vector3f> positions, double spacing) {
    core::ParticleSnapshot snapshot;
    snapshot.spacing = spacing;
    snapshot.positions = std::move(positions);
    snapshot.bounds = core::boundsOf(snapshot.positions);
    return snapshot;
  }

  /// What the look's smoothing makes of a surface on another kind of device.
  render::FloatPicture smoothOn(const render::DeviceTraits& device, const render::FloatPicture& surface,
                                const core::Camera& camera, double spacing) {
    return render::FluidRenderer(*context_, device).smooth(surface, look, spacing, camera);
  }

  gl::Context& context() { return *context_; }

  /// Looks along -z from the origin.
  static core::Camera alongZ(float fovDegrees = 45.0F) { return {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, fovDegrees}; }

 private:
  std::unique_ptr<gl::Context> context_ = gl::Context::create(gl::DebugOutput::On);
  gl::DebugMessages messages_;

 protected:
  v1::Scene scene;
  v1::Look& look = *scene.mutable_look();
  v1::Background& background = *scene.mutable_background();
  v1::Sun& sun = *scene.mutable_lighting()->mutable_sun();
  render::FluidRenderer renderer{*context_};
};

/// A slab of jittered particles in front of a camera that looks along -z, its front near z = -depth.
inline core::ParticleSnapshot slab(float depth, float halfWidth, float spacing, float tilt = 0.0F) {
  core::ParticleSnapshot snapshot;
  snapshot.spacing = spacing;
  std::mt19937 random(7);
  const auto jitter = [&] {
    return 0.25F * spacing * (2.0F * static_cast<float>(random() >> 8) / static_cast<float>(1U << 24) - 1.0F);
  };
  for (int layer = 0; layer < 3; ++layer) {
    for (float y = -halfWidth; y <= halfWidth; y += spacing) {
      for (float x = -halfWidth; x <= halfWidth; x += spacing) {
        const float px = x + jitter();
        const float py = y + jitter();
        const float pz = -depth - tilt * px - static_cast<float>(layer) * spacing + jitter();
        snapshot.positions.emplace_back(px, py, pz);
      }
    }
  }
  snapshot.bounds = core::boundsOf(snapshot.positions);
  return snapshot;
}

}  // namespace sluice::testing
