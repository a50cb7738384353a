#include "log_lines.h"

#include <google/protobuf/stubs/logging.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

namespace sluice::app {

void startLog(LogFormat format) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("sluice"));
  // What a viewer sends that is no protobuf closes its connection, and need not fill the log besides.
  google::protobuf::SetLogHandler(nullptr);
  // Events bring the rest of the object; what else is logged is a message in one.
  if (format == LogFormat::Json) spdlog::set_pattern("%v");
}

void logEvent(LogFormat format, const stream::LogEvent& event) {
  if (format == LogFormat::Json) {
    const auto now = std::chrono::time_point_cast<std::chrono::milliseconds>(std::chrono::system_clock::now());
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    nlohmann::ordered_json line = {
        {"time", fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                             utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec, now.time_since_epoch().count() % 1000)},
        {"level", "info"},
        {"event", event.name}};
    for (const auto& [key, value] : event.fields) line[std::string(key)] = value;
    spdlog::info("{}", line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return;
  }
  std::string line(event.name);
  for (const auto& [key, value] : event.fields) line += fmt::format(" {}={}", key, value);
  spdlog::info("{}", line);
}

}  // namespace sluice::app
