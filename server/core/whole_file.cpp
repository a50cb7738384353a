#include "sluice/core/whole_file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "sluice/core/input_error.h"

namespace sluice::core {

namespace {

// Some systems refuse to write 2 GiB or more at once.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30U;

/// The system's number for what went wrong; 0 where nothing did.
int writeAll(int descriptor, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), std::min(bytes.size(), kMostAtOnce));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  // Disks that report a failure late report it here, before the old file is given up.
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

int writePart(const std::filesystem::path& part, std::span<const std::uint8_t> bytes) {
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return errno;
  const int failure = writeAll(descriptor, bytes);
  const int closing = ::close(descriptor) == 0 ? 0 : errno;
  return failure != 0 ? failure : closing;
}

}  // namespace

std::vector<std::uint8_t> readWholeFile(const std::filesystem::path& file, std::uintmax_t mostBytes) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw InputError(file.string(), "", "no such file");
  if (!fs::is_regular_file(status)) throw InputError(file.string(), "", "is not a file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw InputError(file.string(), "", "cannot be read: " + error.message());
  if (size > mostBytes) {
    throw InputError(file.string(), "",
                     "has " + std::to_string(size) + " bytes; allowed are at most " + std::to_string(mostBytes));
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), "", "cannot be opened for reading");
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) {
    throw InputError(file.string(), "", "cannot be read, or became shorter meanwhile");
  }
  return bytes;
}

void writeWholeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  std::filesystem::path part = file;
  part += ".part";
  std::error_code error(writePart(part, bytes), std::generic_category());
  if (!error) std::filesystem::rename(part, file, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw InputError(file.string(), "", "cannot be written: " + error.message());
}

}  // namespace sluice::core
