#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace sluice::media {

struct Mp4Settings {
  int width = 0;  ///< Pixels; a stream of H.264 codes even sizes alone, so an odd one is written one larger.
  int height = 0;
  double framesPerSecond = 25;  ///< Taken as the nearest fraction with a denominator up to 1001.
};

/// Puts packets of H.264 (Annex B, without reordering) into an MP4 file of constant frame rate, colours tagged as
/// BT.709 limited range, the index in front so that the file plays while it loads. For one thread at a time.
///
/// The file stands under `path` + ".part" until `finish`. All throw core::InputError that names the path.
class Mp4Writer {
 public:
  /// Throws where the file cannot be made.
  Mp4Writer(std::filesystem::path path, const Mp4Settings& settings);
  /// Removes a file that was not finished.
  ~Mp4Writer();
  Mp4Writer(const Mp4Writer&) = delete;
  Mp4Writer& operator=(const Mp4Writer&) = delete;

  /// The next frame, shown at frames()/framesPerSecond. The first is a keyframe with its parameter sets.
  void write(std::span<const std::uint8_t> packet, bool keyframe);

  std::uint64_t frames() const;

  /// Completes the file and gives it its name. Throws where no frame was written. Nothing may be written after it.
  void finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sluice::media
