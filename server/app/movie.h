#pragma once

#include <memory>
#include <string>

#include "sluice/core/frame.h"

namespace sluice::app {

/// Where the frames of an animation go. For one thread.
class Movie {
 public:
  virtual ~Movie() = default;

  /// The frames come in order. Throws core::InputError where the disk refuses.
  virtual void write(int number, const core::Frame& frame) = 0;

  /// After the last frame.
  virtual void finish() {}
};

/// A path that ends in ".mp4": one file of H.264 at constant rate, of the given quality (1..100), which gets its name
/// once it is finished. Any other: a folder for frame_0000.png and so on. Throws core::InputError where it cannot be
/// made, core::EnvironmentError where this build has no video.
std::unique_ptr<Movie> openMovie(const std::string& path, core::ImageSize size, double framesPerSecond, int quality);

}  // namespace sluice::app
