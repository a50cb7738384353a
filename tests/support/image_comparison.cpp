#include "image_comparison.h"

#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

namespace sluice::testing {

namespace {

std::optional<core::Frame> readPng(const std::string& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0) return std::nullopt;
  image.format = PNG_FORMAT_RGBA;
  core::Frame frame;
  frame.size = {static_cast<int>(image.width), static_cast<int>(image.height)};
  frame.pixels.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, frame.pixels.data(), 0, nullptr) == 0) return std::nullopt;
  return frame;
}

bool writePng(const std::string& file, const core::Frame& frame) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(frame.size.width);
  image.height = static_cast<png_uint_32>(frame.size.height);
  image.format = PNG_FORMAT_RGBA;
  return png_image_write_to_file(&image, file.c_str(), 0, frame.pixels.data(), 0, nullptr) != 0;
}

}  // namespace

std::string compareWithGolden(const std::string& name, const core::Frame& actual, Tolerance tolerance) {
  const std::string golden = std::string(SLUICE_GOLDEN_FOLDER) + "/" + name + ".png";
  const std::string output = std::string(SLUICE_GOLDEN_OUTPUT) + "/" + name;
  std::filesystem::create_directories(SLUICE_GOLDEN_OUTPUT);
  if (const char* update = std::getenv("UPDATE"); update != nullptr && std::string(update) == "1") {
    return writePng(golden, actual) ? "" : "cannot write " + golden;
  }

  const auto fail = [&](const std::string& problem) {
    writePng(output + "_actual.png", actual);
    return name + ": " + problem + "; see " + output + "_actual.png";
  };
  const std::optional<core::Frame> expected = readPng(golden);
  if (!expected) return fail("cannot read " + golden);
  if (expected->size != actual.size) return fail("its size is not the golden's");

  core::Frame difference = actual;
  std::size_t failing = 0;
  int largest = 0;
  for (std::size_t i = 0; i < actual.pixels.size(); i += 4) {
    int worst = 0;
    for (std::size_t channel = 0; channel < 4; ++channel) {
      const int d = std::abs(static_cast<int>(actual.pixels[i + channel]) - expected->pixels[i + channel]);
      worst = std::max(worst, d);
      difference.pixels[i + channel] = static_cast<std::uint8_t>(channel == 3 ? 255 : std::min(255, 8 * d));
    }
    largest = std::max(largest, worst);
    if (worst > tolerance.perChannel) ++failing;
  }
  const double fraction = 4.0 * static_cast<double>(failing) / static_cast<double>(actual.pixels.size());
  if (fraction <= tolerance.failingFraction) return "";
  writePng(output + "_diff.png", difference);
  return fail(std::to_string(100 * fraction) + " % of the pixels differ, by up to " + std::to_string(largest));
}

}  // namespace sluice::testing
