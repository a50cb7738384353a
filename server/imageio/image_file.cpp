#include "sluice/imageio/image_file.h"

#include <fstream>
#include <string_view>
#include <system_error>

#include "readers.h"
#include "sluice/core/input_error.h"

namespace sluice::imageio {

namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> readBytes(const fs::path& file) {
  // A flat RGBE picture of the most pixels, with room for its header.
  constexpr std::uintmax_t kLargest = 4 * kMostPixels + (1U << 20U);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw core::InputError(file.string(), "", "no such file");
  if (!fs::is_regular_file(status)) throw core::InputError(file.string(), "", "is not a file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw core::InputError(file.string(), "", "cannot be read: " + error.message());
  if (size > kLargest) {
    throw core::InputError(file.string(), "",
                           "has " + std::to_string(size) + " bytes; allowed are at most " + std::to_string(kLargest));
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw core::InputError(file.string(), "", "cannot be opened for reading");
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) {
    throw core::InputError(file.string(), "", "cannot be read, or became shorter meanwhile");
  }
  return bytes;
}

}  // namespace

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

LinearImage readImage(const fs::path& file) { return decodeImage(readBytes(file), file.string()); }

}  // namespace sluice::imageio
