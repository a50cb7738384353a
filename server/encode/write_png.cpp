#include <cerrno>
#include <cstring>
#include <fstream>

#include "png_encoder.h"
#include "sluice/core/input_error.h"
#include "sluice/encode/frame_encoder.h"

namespace sluice::encode {

void writePng(const core::Frame& frame, const std::string& path) {
  const std::vector<std::uint8_t> bytes = PngEncoder().encode(frame).bytes;

  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    throw core::InputError(path, "", std::string("cannot be written: ") + std::strerror(errno != 0 ? errno : EIO));
  }
}

}  // namespace sluice::encode
