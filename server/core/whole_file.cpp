#include "sluice/core/whole_file.h"

#include <algorithm>
#include <cerrno>
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
