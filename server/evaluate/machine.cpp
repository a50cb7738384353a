#include "machine.h"

#include <algorithm>
#include <fstream>
#include <thread>

namespace sluice::evaluate {

namespace {

std::string modelName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
    return begin == std::string::npos ? "unknown processor" : line.substr(begin);
  }
  return "unknown processor";
}

}  // namespace

std::string processorName() {
  return modelName() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

std::string machineName(const gl::Context& context) { return context.rendererName() + ", " + processorName(); }

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace sluice::evaluate
