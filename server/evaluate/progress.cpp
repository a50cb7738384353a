#include "progress.h"

#include <chrono>
#include <cmath>

#include "sluice/evaluate/report.h"

namespace sluice::evaluate {

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

std::string progressBar(std::size_t done, std::size_t all) {
  constexpr std::size_t kWidth = 20;
  const std::size_t full = all == 0 ? kWidth : done * kWidth / all;
  std::string bar = "[";
  bar.append(full, '#').append(kWidth - full, '-');
  return bar.append("]");
}

Progress::Progress(const Options& options, std::size_t parts) : options_(options), parts_(parts), start_(now()) {}

void Progress::begin(const std::string& name, bool kept) {
  std::string text = progressBar(begun_, parts_) + " " + std::to_string(begun_) + " of " + std::to_string(parts_);
  if (run_ > 0) {
    // As if the parts to come took as long as those that were run.
    const double left = (now() - start_) * static_cast<double>(parts_ - begun_) / static_cast<double>(run_);
    text += ", " + shortText(std::round(left)) + " s left";
  }
  options_.tell(text + ": " + name);
  ++begun_;
  if (!kept) ++run_;
}

}  // namespace sluice::evaluate
