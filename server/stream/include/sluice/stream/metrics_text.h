#pragma once

#include <string>
#include <string_view>

namespace sluice::stream {

/// Writes metrics in the text format of Prometheus, version 0.0.4. Names are the caller's, in its conventions: base
/// units, counters ending in "_total".
class MetricsText {
 public:
  /// Only rises while the process lives.
  void counter(std::string_view name, std::string_view help, double value) { add(name, help, "counter", value); }

  /// Rises and falls.
  void gauge(std::string_view name, std::string_view help, double value) { add(name, help, "gauge", value); }

  const std::string& text() const { return text_; }

 private:
  void add(std::string_view name, std::string_view help, std::string_view type, double value);

  std::string text_;
};

}  // namespace sluice::stream
