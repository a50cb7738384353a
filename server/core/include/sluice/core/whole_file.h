#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace sluice::core {

/// The whole of a file of `mostBytes` at most. Throws InputError with the path and what is wrong: no such file, no
/// regular file, too large, not allowed, or shorter than it was when the reading began. Thread-safe.
std::vector<std::uint8_t> readWholeFile(const std::filesystem::path& file, std::uintmax_t mostBytes);

/// Writes a file that appears under its name only once it is whole and on the disk: it grows beside it as "NAME.part",
/// which a failure takes away again, and a file that was there before stays until then. Throws InputError with the path
/// and the system's reason: no such folder, not allowed, no space left. Thread-safe for different files.
void writeWholeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

}  // namespace sluice::core
