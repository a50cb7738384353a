#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "sluice/v1/scene.pb.h"

namespace sluice::client {

// Values as people write them on the command line. All throw UsageError, naming the text and what is allowed.

/// "1,2,3".
v1::Vec3 parseVector(std::string_view text);

struct PictureSize {
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
};

/// "1280x720".
PictureSize parseSize(std::string_view text);

/// A point of a picture: from its left edge and from its top, as shares of its width and height.
struct PicturePoint {
  double x = 0.5;
  double y = 0.5;
};

/// "0.5,0.25", each from 0 to 1.
PicturePoint parsePicturePoint(std::string_view text);

/// "x,y,z:x,y,z[:fovDegrees]", eye and target; what it does not say is taken from `base`.
v1::Camera parseCamera(std::string_view text, const v1::Camera& base);

/// As short as a number can be written so that the same number is read from it.
std::string formatExact(double number);

/// "1,2,3", each as formatExact.
std::string formatVector(const v1::Vec3& vector);

}  // namespace sluice::client
