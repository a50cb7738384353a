#include "read_bytes.h"

#include <fstream>
#include <string>
#include <system_error>

#include "sluice/core/input_error.h"

namespace sluice::particleio {

namespace fs = std::filesystem;

std::vector<std::uint8_t> readBytes(const fs::path& file) {
  // 100 million particles and more; a larger file is not what a picture is made of.
  constexpr std::uintmax_t kLargest = std::uintmax_t{4} << 30U;
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

}  // namespace sluice::particleio
