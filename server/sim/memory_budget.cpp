#include "memory_budget.h"

#include <fstream>
#include <numbers>
#include <string>

#include <unistd.h>

namespace sluice::sim {

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

}  // namespace sluice::sim
