#pragma once

#include "sluice/particleio/particle_file.h"

// One reader and one writer a format; what they promise stands at decode and encode.
namespace sluice::particleio {

using Bytes = std::vector<std::uint8_t>;

ParticleFileData decodeBgeo(std::span<const std::uint8_t> bytes, const std::string& name);
ParticleFileData decodeVtk(std::span<const std::uint8_t> bytes, const std::string& name);
ParticleFileData decodePly(std::span<const std::uint8_t> bytes, const std::string& name);
/// Xyz and Csv.
ParticleFileData decodeText(std::span<const std::uint8_t> bytes, const std::string& name);

Bytes encodeBgeo(const ParticleFileData& particles);
Bytes encodeVtk(const ParticleFileData& particles);
Bytes encodePly(const ParticleFileData& particles);
Bytes encodeXyz(const ParticleFileData& particles);
Bytes encodeCsv(const ParticleFileData& particles);

}  // namespace sluice::particleio
