#include "read_bytes.h"

#include "sluice/core/whole_file.h"

namespace sluice::particleio {

std::vector<std::uint8_t> readBytes(const std::filesystem::path& file) {
  // 100 million particles and more; a larger file is not what a picture is made of.
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{4} << 30U;
  return core::readWholeFile(file, kMostBytes);
}

}  // namespace sluice::particleio
