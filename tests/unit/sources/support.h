#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "sluice/core/input_error.h"
#include "sluice/particleio/particle_file.h"
#include "sluice/scene/scene.h"
#include "sluice/sources/particle_playback.h"

namespace sluice::sources::test {

/// A cubic lattice of n³ particles from the origin on.
inline particleio::ParticleFileData lattice(int n, float spacing) {
  particleio::ParticleFileData particles;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        particles.positions.push_back(
            spacing * Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
      }
    }
  }
  return particles;
}

/// A test with a folder of its own.
class WithFolder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("sluice_sources_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Frame i of a lattice that has moved i metres along x.
  std::filesystem::path writeFrame(int number, int width = 4, const std::string& ending = ".bgeo") const {
    std::string digits = std::to_string(number);
    digits.insert(
        0, static_cast<std::size_t>(width) - std::min<std::size_t>(digits.size(), static_cast<std::size_t>(width)),
        '0');
    particleio::ParticleFileData particles = lattice(4, 0.1F);
    for (Eigen::Vector3f& position : particles.positions) position.x() += static_cast<float>(number);
    const std::filesystem::path file = folder_ / ("frame_" + digits + ending);
    particleio::writeParticleFile(file, particles);
    return file;
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static v1::Scene sceneOf(const std::string& file) {
    v1::Scene scene;
    scene.mutable_particle_file()->set_path(file);
    scene::complete(scene);
    return scene;
  }

  static std::string openError(const std::string& file) {
    try {
      openParticlePlayback(sceneOf(file));
    } catch (const core::InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << file << " was opened";
    return {};
  }

  std::filesystem::path folder_;
};

}  // namespace sluice::sources::test
