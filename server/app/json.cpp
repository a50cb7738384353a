#include "json.h"

namespace sluice::app {

Json toJson(const core::StageTimes& times) {
  Json json = Json::object();
  for (const core::StageTime& stage : times) json[stage.name] = stage.milliseconds;
  return json;
}

Json toJson(const std::vector<core::LeftOut>& leftOut) {
  Json json = Json::array();
  for (const core::LeftOut& entry : leftOut) json.push_back({{"name", entry.name}, {"reason", entry.reason}});
  return json;
}

Json toJson(const core::Plan& plan) {
  Json stages = Json::array();
  for (const core::PlannedStage& stage : plan.stages) {
    stages.push_back({{"name", stage.name}, {"reads", stage.reads}, {"writes", stage.writes}});
  }
  Json buffers = Json::array();
  for (const core::PlannedBuffer& buffer : plan.buffers) {
    buffers.push_back({{"name", buffer.name}, {"bytes", buffer.bytes}});
  }
  return {{"stages", stages}, {"buffers", buffers}, {"left_out", toJson(plan.leftOut)}};
}

}  // namespace sluice::app
