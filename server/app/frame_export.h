#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "sluice/core/particle_source.h"
#include "sluice/particleio/particle_file.h"

namespace sluice::app {

/// Particles as numbered files, one at each multiple of 1/framesPerSecond from the source's present time on.
class FrameExport {
 public:
  /// `format` is one of `formats`. Makes the folder. Throws core::InputError where it cannot be made.
  FrameExport(std::filesystem::path folder, const std::string& format, double framesPerSecond, double startSeconds);

  static const std::vector<std::string>& formats();

  /// Time of the next file, s.
  double nextSeconds() const { return static_cast<double>(next_) / framesPerSecond_; }

  /// Writes it: "frame_0012.ply". Throws core::InputError where the disk refuses.
  void write(const core::ParticleSource& source);

  std::uint64_t written() const { return written_; }

 private:
  std::filesystem::path folder_;
  std::string ending_;
  particleio::Format format_;
  double framesPerSecond_;
  std::uint64_t next_ = 0;
  std::uint64_t written_ = 0;
};

}  // namespace sluice::app
