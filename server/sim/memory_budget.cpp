#include "memory_budget.h"

#include <algorithm>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include <unistd.h>

namespace sluice::sim {

namespace {

std::string gigabytes(double bytes) {
  std::ostringstream text;
  text.precision(3);
  text << bytes / 1e9 << " GB";
  return text.str();
}

}  // namespace

std::uint64_t availableMemory() {
  // What Linux says could be given without swapping.
  std::ifstream info("/proc/meminfo");
  std::string name;
  std::uint64_t kibibytes = 0;
  std::string unit;
  while (info >> name >> kibibytes && std::getline(info, unit)) {
    if (name == "MemAvailable:") return kibibytes * 1024;
  }
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t bytesPerParticle(const Discretisation& discretisation) {
  constexpr double kBytesPerPair = 12;
  constexpr double kOwnBytes = 300;
  const double reach = discretisation.support / discretisation.spacing;
  const double neighbours = discretisation.dimensions == 2 ? std::numbers::pi * reach * reach
                                                           : 4 * std::numbers::pi / 3 * reach * reach * reach;
  return static_cast<std::uint64_t>(kOwnBytes + kBytesPerPair * neighbours);
}

ParticleLimit particleLimit(const Discretisation& discretisation, std::uint64_t freeBytes, std::uint64_t allowed) {
  // Particles are numbered with 32 bits, of which the pair loops use the sign.
  constexpr std::uint64_t kMostParticles = (std::uint64_t{1} << 31) - 1;
  const std::uint64_t each = bytesPerParticle(discretisation);
  // 0.8: the rest of the program needs memory too.
  const auto affordable = static_cast<std::uint64_t>(0.8 * static_cast<double>(freeBytes)) / each;
  const std::uint64_t most = std::min(affordable, kMostParticles);
  if (allowed > 0 && allowed < most) return {allowed, each, "the server's operator allows"};
  if (most < affordable) return {most, each, "their numbering allows"};
  return {most, each, gigabytes(static_cast<double>(freeBytes)) + " of free memory allows"};
}

std::string ParticleLimit::explain(double particles) const {
  return "about " + gigabytes(particles * static_cast<double>(bytesEach)) + " at " + std::to_string(bytesEach) +
         " bytes each; " + reason + " " + std::to_string(count);
}

}  // namespace sluice::sim
