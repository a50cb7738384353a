#include "sluice/stream/metrics_text.h"

#include <array>
#include <charconv>

namespace sluice::stream {

void MetricsText::add(std::string_view name, std::string_view help, std::string_view type, double value) {
  std::array<char, 32> number{};
  const auto [end, error] = std::to_chars(number.data(), number.data() + number.size(), value);
  text_.append("# HELP ").append(name).append(" ").append(help).append("\n# TYPE ").append(name).append(" ");
  text_.append(type).append("\n").append(name).append(" ").append(number.data(), end).append("\n");
}

}  // namespace sluice::stream
