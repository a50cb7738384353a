#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sluice::particleio {

/// The whole file. Throws core::InputError where there is none, it is too large or it cannot be read.
std::vector<std::uint8_t> readBytes(const std::filesystem::path& file);

}  // namespace sluice::particleio
