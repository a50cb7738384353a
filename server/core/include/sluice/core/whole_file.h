#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace sluice::core {

/// Writes a file that appears under its name only once it is whole and on the disk: it grows beside it as "NAME.part",
/// which a failure takes away again, and a file that was there before stays until then. Throws InputError with the path
/// and the system's reason: no such folder, not allowed, no space left. Thread-safe for different files.
void writeWholeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

}  // namespace sluice::core
