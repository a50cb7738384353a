#include "smoothing/measure.h"

#include <algorithm>
#include <chrono>
#include <vector>

#include "machine.h"
#include "metrics/sight.h"

namespace sluice::evaluate {

namespace {

struct TimedFrame {
  core::Frame frame;
  double milliseconds = 0;
};

TimedFrame drawTimed(render::FluidRenderer& renderer, const core::ParticleSnapshot& particles, const Setting& setting) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  core::Frame frame = renderer.render(particles, setting.scene, setting.camera, setting.size);
  return {std::move(frame), std::chrono::duration<double, std::milli>(Clock::now() - start).count()};
}

}  // namespace

double stageMilliseconds(const core::Frame& frame, const std::string& stage) {
  const auto found = std::ranges::find(frame.tag.stages, stage, &core::StageTime::name);
  return found == frame.tag.stages.end() ? 0 : found->milliseconds;
}

std::int64_t stageSweeps(const core::Plan& plan, const std::string& stage) {
  const auto found = std::ranges::find(plan.stages, stage, &core::PlannedStage::name);
  return found == plan.stages.end() ? 0 : found->sweeps;
}

MeasuredSurface measureSurface(render::FluidRenderer& renderer, const core::ParticleSnapshot& particles,
                               const Setting& setting, const std::string& stage) {
  Setting away = setting;
  away.camera = turned(setting.camera, kTurnDegrees);
  drawTimed(renderer, particles, away);

  MeasuredSurface measured;
  std::vector<double> stages;
  std::vector<double> frames;
  for (int i = 0; i < kTimedFrames; ++i) {
    const bool home = i % 2 == 0;
    const TimedFrame timed = drawTimed(renderer, particles, home ? setting : away);
    stages.push_back(stageMilliseconds(timed.frame, stage));
    frames.push_back(timed.milliseconds);
    if (i + 2 < kTimedFrames) continue;
    (home ? measured.q : measured.turnedQ) = renderer.readBuffer(render::Resource::Surface);
  }
  measured.stageMilliseconds = median(stages);
  measured.frameMilliseconds = median(frames);
  measured.sweeps = stageSweeps(renderer.plan(), stage);
  return measured;
}

MeasuredFrames measureFrames(render::FluidRenderer& renderer, const core::ParticleSnapshot& particles, Setting setting,
                             const std::string& stage, int frames) {
  std::vector<double> whole;
  std::vector<double> stages;
  for (int i = 0; i <= frames; ++i) {
    setting.camera = turned(setting.camera, kTurnDegrees);
    const TimedFrame timed = drawTimed(renderer, particles, setting);
    if (i == 0) continue;  // warms up
    whole.push_back(timed.milliseconds);
    stages.push_back(stageMilliseconds(timed.frame, stage));
  }
  return {median(whole), median(stages), stageSweeps(renderer.plan(), stage)};
}

}  // namespace sluice::evaluate
