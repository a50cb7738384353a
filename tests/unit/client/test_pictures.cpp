#include "test_pictures.h"

#include <stdexcept>
#include <vector>

#include <png.h>
#include <turbojpeg.h>

namespace sluice::client {

namespace {

std::vector<unsigned char> pixels(int width, int height, std::uint32_t rgb) {
  std::vector<unsigned char> result;
  for (int i = 0; i < width * height; ++i) {
    for (const unsigned shift : {16U, 8U, 0U}) result.push_back(static_cast<unsigned char>(rgb >> shift));
  }
  return result;
}

}  // namespace

std::string pngOf(int width, int height, std::uint32_t rgb) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  std::string bytes(1U << 16U, '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels(width, height, rgb).data(), 0, nullptr) == 0) {
    throw std::runtime_error(image.message);
  }
  bytes.resize(size);
  return bytes;
}

std::string jpegOf(int width, int height, std::uint32_t rgb) {
  const tjhandle handle = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const int failed = tjCompress2(handle, pixels(width, height, rgb).data(), width, 0, height, TJPF_RGB, &bytes, &size,
                                 TJSAMP_444, 95, 0);
  const std::string result(reinterpret_cast<char*>(bytes), size);
  tjFree(bytes);
  tjDestroy(handle);
  if (failed != 0) throw std::runtime_error("the test's JPEG cannot be made");
  return result;
}

}  // namespace sluice::client
