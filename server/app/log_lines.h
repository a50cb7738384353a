#pragma once

#include <string>

#include "sluice/stream/server.h"

namespace sluice::app {

/// Lines of the log as people read them, or each a JSON object with "time" (RFC 3339, UTC), "level" and "event".
enum class LogFormat { Text, Json };

/// Directs the program's log to stderr in this form.
void startLog(LogFormat format);

/// Writes a line. Thread-safe.
void logEvent(LogFormat format, const stream::LogEvent& event);

}  // namespace sluice::app
