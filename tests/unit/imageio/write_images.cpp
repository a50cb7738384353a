#include "write_images.h"

#include <png.h>
#include <turbojpeg.h>

namespace sluice::imageio::test {

namespace {

void append(png_structp png, png_bytep data, std::size_t size) {
  auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
  bytes.insert(bytes.end(), data, data + size);
}

Bytes writePng(core::ImageSize size, int bitDepth, int colourType, const Bytes& rows, bool interlaced) {
  Bytes bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(size.width), static_cast<png_uint_32>(size.height), bitDepth,
               colourType, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (colourType == PNG_COLOR_TYPE_PALETTE) {
    const png_color palette[] = {{255, 0, 0}, {0, 0, 255}};
    png_set_PLTE(png, info, palette, 2);
  }
  png_write_info(png, info);
  const std::size_t rowBytes = png_get_rowbytes(png, info);
  EXPECT_EQ(rows.size(), rowBytes * static_cast<std::size_t>(size.height));
  std::vector<png_bytep> pointers;
  for (int row = 0; row < size.height; ++row) {
    pointers.push_back(const_cast<png_bytep>(rows.data()) + rowBytes * static_cast<std::size_t>(row));
  }
  png_write_image(png, pointers.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace

Bytes png(core::ImageSize size, int bitDepth, int colourType, const Bytes& rows, bool interlaced) {
  return writePng(size, bitDepth, colourType, rows, interlaced);
}

Bytes palettePng(core::ImageSize size, const Bytes& rows) {
  return writePng(size, 1, PNG_COLOR_TYPE_PALETTE, rows, false);
}

Bytes jpeg(core::ImageSize size, const Bytes& rgb, bool progressive) {
  tjhandle encoder = tjInitCompress();
  unsigned char* data = nullptr;
  unsigned long length = 0;
  EXPECT_EQ(tjCompress2(encoder, rgb.data(), size.width, 0, size.height, TJPF_RGB, &data, &length, TJSAMP_444, 95,
                        progressive ? TJFLAG_PROGRESSIVE : 0),
            0);
  Bytes bytes(data, data + length);
  tjFree(data);
  tjDestroy(encoder);
  return bytes;
}

}  // namespace sluice::imageio::test
