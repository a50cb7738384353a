#include "png_encoder.h"

#include <png.h>

#include <csetjmp>
#include <memory>
#include <string>

#include "encoded_frame.h"
#include "sluice/core/input_error.h"

namespace sluice::encode {

namespace {

struct Output {
  std::vector<std::uint8_t> bytes;
  std::string error;
};

// libpng calls these through C frames, where no exception may pass: running out of memory becomes a png_error.
void append(png_structp png, png_bytep data, std::size_t size) {
  auto& output = *static_cast<Output*>(png_get_io_ptr(png));
  bool appended = true;
  try {
    output.bytes.insert(output.bytes.end(), data, data + size);
  } catch (const std::bad_alloc&) {
    appended = false;
  }
  if (!appended) png_error(png, "out of memory");
}

void fail(png_structp png, png_const_charp message) {
  auto& output = *static_cast<Output*>(png_get_error_ptr(png));
  output.error = message;
  png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

struct Writer {
  Writer(Output& output)
      : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, fail, ignoreWarning)),
        info(png != nullptr ? png_create_info_struct(png) : nullptr) {
    if (info == nullptr) output.error = "out of memory";
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  png_structp png;
  png_infop info;
};

// Everything between setjmp and a longjmp lives here, and nothing here has a destructor that a jump would skip.
bool writeImage(png_structp png, png_infop info, Output& output, const std::uint8_t* pixels, core::ImageSize size) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;

  png_set_write_fn(png, &output, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(size.width), static_cast<png_uint_32>(size.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_compression_level(png, 1);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  // One IDAT chunk per 256 KiB rather than per 8 KiB.
  png_set_compression_buffer_size(png, 1U << 18U);
  png_write_info(png, info);
  png_set_filler(png, 0, PNG_FILLER_AFTER);  // The fourth byte of a pixel is left out.

  const std::size_t stride = 4U * static_cast<std::size_t>(size.width);
  for (int row = 0; row < size.height; ++row) png_write_row(png, pixels + row * stride);
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

std::vector<std::uint8_t> toPng(const core::Frame& frame) {
  Output output;
  // Pictures of water take about a third of their raw size.
  output.bytes.reserve(frame.pixels.size() / 3 + 1024);
  const Writer writer(output);
  if (writer.info == nullptr || !writeImage(writer.png, writer.info, output, frame.pixels.data(), frame.size)) {
    throw core::EnvironmentError("cannot encode a PNG: " + output.error);
  }
  return std::move(output.bytes);
}

core::EncodedFrame PngEncoder::encode(const core::Frame& frame) {
  return encodeTimed(frame, core::Codec::Png, [&] { return toPng(frame); });
}

}  // namespace sluice::encode
