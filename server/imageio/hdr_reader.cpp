// Radiance pictures of RGBE pixels [Ward, Real Pixels, Graphics Gems II, 1991; the file format: Ward, "Radiance File
// Formats", 1992]: a header of lines, a line with both sizes, then scanlines, flat or run-length encoded in the old or
// the new way.
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "readers.h"
#include "sluice/core/input_error.h"

namespace sluice::imageio {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

class Bytes {
 public:
  Bytes(std::span<const std::uint8_t> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::uint8_t next() {
    if (offset_ == bytes_.size()) fail("the file is cut off");
    return bytes_[offset_++];
  }

  Rgbe pixel() {
    Rgbe pixel;
    for (std::uint8_t& byte : pixel) byte = next();
    return pixel;
  }

  /// The next four bytes, which stay; nothing where there are fewer.
  std::optional<Rgbe> peek() const {
    if (bytes_.size() - offset_ < 4) return std::nullopt;
    Rgbe pixel;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset_), 4, pixel.begin());
    return pixel;
  }

  std::string_view line() {
    const std::string_view rest(reinterpret_cast<const char*>(bytes_.data()) + offset_, bytes_.size() - offset_);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) fail("the header does not end");
    offset_ += end + 1;
    return rest.substr(0, end);
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw core::InputError(name_, "", "at byte " + std::to_string(offset_) + ": " + problem);
  }

  const std::string& name() const { return name_; }

 private:
  std::span<const std::uint8_t> bytes_;
  const std::string& name_;
  std::size_t offset_ = 0;
};

/// One of the two axes of the line with the sizes: "-Y 512".
struct Axis {
  char name = 'Y';
  bool falling = false;
  std::size_t count = 0;
};

struct Header {
  float factor = 1;  ///< From stored values to radiance.
  Axis scanlines;    ///< Along which one scanline follows another,
  Axis pixels;       ///< and one pixel another within.
};

Axis parseAxis(std::string_view& text, const Bytes& bytes) {
  const bool known =
      text.size() > 3 && (text[0] == '+' || text[0] == '-') && (text[1] == 'X' || text[1] == 'Y') && text[2] == ' ';
  if (!known) bytes.fail("the line with the sizes is to read like \"-Y 512 +X 1024\"");
  Axis axis{text[1], text[0] == '-', 0};
  text.remove_prefix(3);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), axis.count);
  if (error != std::errc{}) bytes.fail("the sizes are to be whole numbers");
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (text.starts_with(' ')) text.remove_prefix(1);
  return axis;
}

Header readHeader(Bytes& bytes) {
  constexpr std::string_view kFormat = "FORMAT=";
  constexpr std::string_view kExposure = "EXPOSURE=";
  Header header;
  for (std::string_view line = bytes.line(); !line.empty(); line = bytes.line()) {
    if (line.starts_with(kFormat) && line.substr(kFormat.size()) != "32-bit_rle_rgbe") {
      bytes.fail("pixels are to be 32-bit_rle_rgbe");
    }
    if (!line.starts_with(kExposure)) continue;
    line.remove_prefix(kExposure.size());
    while (line.starts_with(' ')) line.remove_prefix(1);
    float exposure = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), exposure);
    if (error != std::errc{} || !std::isnormal(exposure) || exposure < 0) bytes.fail("EXPOSURE is to be above 0");
    header.factor /= exposure;  // There may be several, each for a filter that the picture went through.
  }
  if (!std::isnormal(header.factor)) bytes.fail("EXPOSURE is out of range");
  std::string_view sizes = bytes.line();
  header.scanlines = parseAxis(sizes, bytes);
  header.pixels = parseAxis(sizes, bytes);
  if (header.scanlines.name == header.pixels.name) bytes.fail("the two sizes are to be of X and of Y");
  checkSize(header.pixels.count, header.scanlines.count, bytes.name());
  return header;
}

/// Each component by itself: a count above 128 and one value, or a count and as many values.
void readNewScanline(Bytes& bytes, std::span<Rgbe> scanline) {
  bytes.pixel();  // 2, 2 and the width
  for (std::size_t component = 0; component < 4; ++component) {
    for (std::size_t at = 0; at < scanline.size();) {
      const std::uint8_t code = bytes.next();
      const std::size_t count = code > 128 ? code - 128U : code;
      if (count == 0 || count > scanline.size() - at) bytes.fail("a run does not fit its scanline");
      const std::uint8_t run = code > 128 ? bytes.next() : 0;
      for (const std::size_t end = at + count; at < end; ++at) {
        scanline[at][component] = code > 128 ? run : bytes.next();
      }
    }
  }
}

/// Whole pixels; 1, 1, 1, n repeats the last one n times, and n·256, n·65536 … times right after another such.
void readOldScanline(Bytes& bytes, std::span<Rgbe> scanline) {
  unsigned shift = 0;
  for (std::size_t at = 0; at < scanline.size();) {
    const Rgbe pixel = bytes.pixel();
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      scanline[at++] = pixel;
      shift = 0;
      continue;
    }
    if (at == 0 || shift > 24) bytes.fail("a run repeats no pixel");
    const std::size_t count = std::size_t{pixel[3]} << shift;
    if (count > scanline.size() - at) bytes.fail("a run does not fit its scanline");
    const Rgbe last = scanline[at - 1];
    for (const std::size_t end = at + count; at < end; ++at) scanline[at] = last;
    shift += 8;
  }
}

void readScanline(Bytes& bytes, std::span<Rgbe> scanline) {
  const std::optional<Rgbe> start = bytes.peek();
  const bool isNew = scanline.size() >= 8 && scanline.size() < 32768 && start && (*start)[0] == 2 && (*start)[1] == 2 &&
                     (*start)[2] == scanline.size() >> 8U && (*start)[3] == (scanline.size() & 255U);
  isNew ? readNewScanline(bytes, scanline) : readOldScanline(bytes, scanline);
}

}  // namespace

LinearImage decodeHdr(std::span<const std::uint8_t> given, const std::string& name) {
  Bytes bytes(given, name);
  const Header header = readHeader(bytes);
  const std::size_t lines = header.scanlines.count;
  const std::size_t length = header.pixels.count;
  // Grows with what comes out of the file, not with what it claims.
  std::vector<Rgbe> pixels;
  for (std::size_t i = 0; i < lines; ++i) {
    pixels.resize((i + 1) * length);
    readScanline(bytes, std::span(pixels).last(length));
  }

  const bool upright = header.scanlines.name == 'Y';
  const std::size_t width = upright ? length : lines;
  const std::size_t height = upright ? lines : length;
  LinearImage image{{static_cast<int>(width), static_cast<int>(height)}, std::vector<float>(3 * width * height)};
  for (std::size_t i = 0; i < lines; ++i) {
    for (std::size_t j = 0; j < length; ++j) {
      // X rises to the right and Y upwards, while rows here go down.
      const std::size_t alongX = upright ? j : i;
      const std::size_t alongY = upright ? i : j;
      const bool leftwards = (upright ? header.pixels : header.scanlines).falling;
      const bool downwards = (upright ? header.scanlines : header.pixels).falling;
      const std::size_t x = leftwards ? width - 1 - alongX : alongX;
      const std::size_t y = downwards ? alongY : height - 1 - alongY;
      const Rgbe& pixel = pixels[i * length + j];
      // 136 = 128, the exponent's bias, + 8 bits of the mantissa. Without Ward's half step, so that 1 stays 1.
      const float scale = pixel[3] == 0 ? 0.0F : std::ldexp(header.factor, pixel[3] - 136);
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = static_cast<float>(pixel[c]) * scale;
        if (!std::isfinite(value)) {
          throw core::InputError(name, "", "holds light that is too bright: EXPOSURE and pixels exceed 3e38");
        }
        image.values[3 * (y * width + x) + c] = value;
      }
    }
  }
  return image;
}

}  // namespace sluice::imageio
