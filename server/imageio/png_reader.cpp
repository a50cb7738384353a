#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>

#include "readers.h"
#include "sluice/core/input_error.h"
#include "srgb.h"

namespace sluice::imageio {

namespace {

struct Input {
  std::span<const std::uint8_t> bytes;
  std::string error;
};

void take(png_structp png, png_bytep data, std::size_t size) {
  auto& input = *static_cast<Input*>(png_get_io_ptr(png));
  if (size > input.bytes.size()) png_error(png, "the file is cut off");
  std::memcpy(data, input.bytes.data(), size);
  input.bytes = input.bytes.subspan(size);
}

void fail(png_structp png, png_const_charp message) {
  static_cast<Input*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

struct Reader {
  explicit Reader(Input& input)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, fail, ignoreWarning)),
        info(png != nullptr ? png_create_info_struct(png) : nullptr) {
    if (info == nullptr) input.error = "out of memory";
  }
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  png_structp png;
  png_infop info;
};

struct Header {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  std::size_t rowBytes = 0;
  int passes = 1;
  int bitDepth = 8;  ///< Of the file, per value or index.
  bool deep() const { return bitDepth == 16; }
};

// libpng leaves by longjmp: between setjmp and there, nothing here has a destructor that a jump would skip.

bool readHeader(png_structp png, png_infop info, Input& input, Header& header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, &input, take);
  // Texts and profiles are of no use here; what a chunk may unpack to is bounded all the same.
  png_set_chunk_malloc_max(png, 1U << 20U);
  png_set_user_limits(png, kMostPixels, kMostPixels);
  png_read_info(png, info);
  header.width = png_get_image_width(png, info);
  header.height = png_get_image_height(png, info);
  header.bitDepth = png_get_bit_depth(png, info);

  png_set_expand(png);  // Palettes, few bits, and a transparent colour become 8 bits a value.
  png_set_strip_alpha(png);
  png_set_gray_to_rgb(png);
  if (header.deep() && std::endian::native == std::endian::little) png_set_swap(png);
  header.passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  header.rowBytes = png_get_rowbytes(png, info);
  return true;
}

bool readPixels(png_structp png, std::uint8_t* pixels, const Header& header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  for (int pass = 0; pass < header.passes; ++pass) {
    for (png_uint_32 row = 0; row < header.height; ++row) png_read_row(png, pixels + row * header.rowBytes, nullptr);
  }
  png_read_end(png, nullptr);
  return true;
}

/// Throws where the file is too short to unpack to so many pixels: Deflate makes at most 1032 bytes of one.
void checkLength(const Header& header, std::size_t fileBytes, const std::string& name) {
  const std::uint64_t packed = std::uint64_t{header.width} * header.height * static_cast<unsigned>(header.bitDepth) / 8;
  if (packed / 1032 > fileBytes) {
    throw core::InputError(name, "",
                           "is cut off: " + std::to_string(header.width) + "x" + std::to_string(header.height) +
                               " pixels cannot be in " + std::to_string(fileBytes) + " bytes");
  }
}

}  // namespace

LinearImage decodePng(std::span<const std::uint8_t> bytes, const std::string& name) {
  Input input{bytes, {}};
  const Reader reader(input);
  const auto refusal = [&] { return core::InputError(name, "", "is no PNG that can be read: " + input.error); };
  Header header;
  if (reader.info == nullptr || !readHeader(reader.png, reader.info, input, header)) throw refusal();
  checkSize(header.width, header.height, name);
  checkLength(header, bytes.size(), name);

  const auto values = 3 * std::size_t{header.width} * header.height;
  LinearImage image{{static_cast<int>(header.width), static_cast<int>(header.height)}, {}};
  if (header.deep()) {
    std::vector<std::uint16_t> pixels(values);
    if (!readPixels(reader.png, reinterpret_cast<std::uint8_t*>(pixels.data()), header)) throw refusal();
    image.values.resize(values);
    toLinear(pixels, image.values);
  } else {
    std::vector<std::uint8_t> pixels(values);
    if (!readPixels(reader.png, pixels.data(), header)) throw refusal();
    image.values.resize(values);
    toLinear(pixels, image.values);
  }
  return image;
}

}  // namespace sluice::imageio
