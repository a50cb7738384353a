#include "sluice/imageio/image_file.h"

#include <string_view>

#include "readers.h"
#include "sluice/core/input_error.h"
#include "sluice/core/whole_file.h"

namespace sluice::imageio {

void checkSize(std::uint64_t width, std::uint64_t height, const std::string& name) {
  // No panorama is wider; it keeps what a reader takes for one row small.
  constexpr std::uint64_t kLongestEdge = 65536;
  if (width == 0 || height == 0 || width > kLongestEdge || height > kLongestEdge || width * height > kMostPixels) {
    throw core::InputError(name, "",
                           "is " + std::to_string(width) + "x" + std::to_string(height) + " pixels; allowed are 1 to " +
                               std::to_string(kLongestEdge) + " along an edge and " + std::to_string(kMostPixels) +
                               " in all");
  }
}

LinearImage decodeImage(std::span<const std::uint8_t> bytes, const std::string& name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\x89PNG\r\n\x1a\n")) return decodePng(bytes, name);
  if (text.starts_with("\xff\xd8\xff")) return decodeJpeg(bytes, name);
  if (text.starts_with("#?")) return decodeHdr(bytes, name);
  throw core::InputError(name, "", "is no picture that is known: PNG, JPEG and Radiance HDR are");
}

LinearImage readImage(const std::filesystem::path& file) {
  // A flat RGBE picture of the most pixels, with room for its header.
  constexpr std::uintmax_t kMostBytes = 4 * kMostPixels + (1U << 20U);
  return decodeImage(core::readWholeFile(file, kMostBytes), file.string());
}

}  // namespace sluice::imageio
