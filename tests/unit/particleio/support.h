#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "sluice/core/input_error.h"
#include "sluice/particleio/particle_file.h"

namespace sluice::particleio::test {

using Bytes = std::vector<std::uint8_t>;

inline constexpr Format kFormats[] = {Format::Bgeo, Format::BgeoGzip, Format::Vtk,
                                      Format::Ply,  Format::Xyz,      Format::Csv};

inline Bytes bytesOf(std::string_view text) { return {text.begin(), text.end()}; }

inline ParticleFileData decodeString(std::string_view text, Format format) {
  return decode(bytesOf(text), format, "file");
}

/// The message of the InputError that decoding throws; empty, and a failure, where it throws none.
inline std::string decodeError(const Bytes& bytes, Format format) {
  try {
    decode(bytes, format, "file");
  } catch (const core::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "was decoded";
  return {};
}

inline std::string decodeError(std::string_view text, Format format) { return decodeError(bytesOf(text), format); }

/// Three particles with everything a file can hold.
inline ParticleFileData someParticles() {
  return {{{0.1F, -2.0F, 3e-7F}, {1e6F, 0.0F, 0.3F}, {-0.25F, 0.5F, 1.0F}},
          {{1, 2, 3}, {-4, 5.5F, 0}, {0, 0, -9.81F}},
          {1000.0F, 998.5F, 0.1F},
          {7, 0, 4294967295U},
          {0.0F, -12.5F, 101325.0F},
          {0, 255, 1}};
}

}  // namespace sluice::particleio::test
