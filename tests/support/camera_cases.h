#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "column_and_sheet.h"

namespace sluice::testing {

/// A camera, and a picture's size, that break careless renderers of columnAndSheet(kCameraCaseParticles).
struct CameraCase {
  std::string name;
  core::Camera camera;
  core::ImageSize size{96, 72};
};

inline void PrintTo(const CameraCase& c, std::ostream* out) { *out << c.name; }

inline constexpr std::size_t kCameraCaseParticles = 1500;

inline std::vector<CameraCase> cameraCases() {
  const Eigen::Vector3f up(0, 1, 0);
  const Eigen::Vector3f middle(0.85F, 0.25F, 0.5F);
  return {{"InsideTheColumn", {{0.25F, 0.3F, 0.5F}, middle, up, 45}},
          {"SkimmingTheSheet", {{1.9F, 0.12F, 0.5F}, {0.2F, 0.11F, 0.5F}, up, 45}},
          {"AtAParticle", {columnAndSheet(kCameraCaseParticles).positions[40], middle, up, 45}},
          {"BehindTheCamera", {{1.9F, 1.25F, 3}, {3, 2, 6}, up, 45}},
          {"NarrowLens", {{1.9F, 1.25F, 3}, middle, up, 5}},
          {"WideLens", {{1.0F, 0.5F, 0.9F}, middle, up, 120}},
          {"WidePicture", {{1.9F, 1.25F, 3}, middle, up, 45}, {240, 60}},
          {"SubPixelSplats", {{200, 150, 300}, middle, up, 45}},
          {"VeryFar", {{4e4F, 3e4F, 6e4F}, middle, up, 1}},
          {"HugeSplats", {{0.85F, 0.25F, 0.56F}, middle, up, 20}, {400, 300}},
          {"StraightDown", {{0.85F, 3, 0.5F}, middle, up, 45}},
          {"EyeAtTarget", {middle, middle, up, 45}},
          {"BelowTheFloor", {{0.85F, -1, 2}, middle, up, 45}},
          {"OnTheFloor", {{0.85F, 0, 2}, {0.85F, 0, 0.5F}, up, 45}},
          {"OnePixel", {{1.9F, 1.25F, 3}, middle, up, 45}, {1, 1}},
          {"OneColumn", {{1.9F, 1.25F, 3}, middle, up, 45}, {1, 33}},
          {"OddSize", {{1.9F, 1.25F, 3}, middle, up, 45}, {101, 67}}};
}

}  // namespace sluice::testing
