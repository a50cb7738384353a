#include "logarithmic_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "sluice/core/check.h"

namespace sluice::evaluate {

void LogarithmicRange::add(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
}

LogarithmicRange LogarithmicRange::padded() const {
  if (!(high > 0)) return {0.1, 10};
  // Markers clear the frame by a few pixels.
  const double factor = std::max(std::pow(high / low, 0.06), 1.15);
  return {low / factor, high * factor};
}

double LogarithmicRange::share(double value) const { return std::log(value / low) / std::log(high / low); }

std::vector<double> logarithmicTicks(double low, double high) {
  SLUICE_CHECK(low > 0 && high >= low);
  // As many as stand apart along an axis: ticks at every 2 and 5 crowd a longer range.
  constexpr double kFew = 2.5;  // powers of ten
  constexpr double kOne = 0.75;
  const double powers = std::log10(high / low);
  std::vector<double> digits{1};
  if (powers <= kFew) digits = {1, 2, 5};
  if (powers <= kOne) digits = {1, 1.5, 2, 3, 4, 5, 6, 8};
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10, power) <= high; ++power) {
    for (const double digit : digits) {
      const double tick = digit * std::pow(10, power);
      if (tick >= low && tick <= high) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::string tickText(double tick) {
  std::ostringstream out;
  if (tick >= 1e6) {
    out << tick / 1e6 << " M";
  } else if (tick >= 1e4) {
    out << tick / 1e3 << " k";
  } else if (tick >= 1e-3) {
    out << tick;
  } else {
    constexpr std::array kSuperscripts{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    // A hair is added, for powers of ten that rounding has put just below.
    const int power = static_cast<int>(std::floor(std::log10(tick) + 1e-9));
    const double digit = tick / std::pow(10, power);
    if (std::abs(digit - 1) > 1e-6) out << digit << "·";
    out << "10⁻";
    for (const char c : std::to_string(-power)) out << kSuperscripts[static_cast<std::size_t>(c - '0')];
  }
  return out.str();
}

}  // namespace sluice::evaluate
