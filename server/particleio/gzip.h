#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sluice::particleio {

bool isGzip(std::span<const std::uint8_t> bytes);

/// Throws core::InputError for damaged or cut off data and for more than `largest` bytes; memory grows with what comes
/// out, not with what the file claims.
std::vector<std::uint8_t> gunzip(std::span<const std::uint8_t> bytes, const std::string& name, std::size_t largest);

std::vector<std::uint8_t> gzip(std::span<const std::uint8_t> bytes);

}  // namespace sluice::particleio
