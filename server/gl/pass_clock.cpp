#include "sluice/gl/pass_clock.h"

namespace sluice::gl {

void PassClock::start() {
  names_.clear();
  times_.clear();
  stamp();
}

void PassClock::lap(std::string_view name) {
  names_.emplace_back(name);
  stamp();
}

core::StageTimes PassClock::finish() {
  core::StageTimes stages;
  std::vector<double> milliseconds(names_.size() + 1);
  for (std::size_t i = 0; i < milliseconds.size(); ++i) {
    if (software_) {
      milliseconds[i] = std::chrono::duration<double, std::milli>(times_[i].time_since_epoch()).count();
    } else {
      GLuint64 nanoseconds = 0;
      glGetQueryObjectui64v(queries_[i].name(), GL_QUERY_RESULT, &nanoseconds);
      milliseconds[i] = static_cast<double>(nanoseconds) * 1e-6;
    }
  }
  for (std::size_t i = 0; i < names_.size(); ++i) {
    core::addStageTime(stages, names_[i], milliseconds[i + 1] - milliseconds[i]);
  }
  return stages;
}

void PassClock::stamp() {
  if (software_) {
    glFinish();
    times_.push_back(Clock::now());
    return;
  }
  const std::size_t index = names_.size();
  if (index >= queries_.size()) queries_.push_back(makeTimestampQuery());
  glQueryCounter(queries_[index].name(), GL_TIMESTAMP);
}

}  // namespace sluice::gl
