#include "sluice/sources/particle_playback.h"

#include <utility>

#include "frame_files.h"
#include "nearest_neighbours.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/particleio/particle_file.h"
#include "source_plan.h"

namespace sluice::sources {

namespace {

namespace fs = std::filesystem;

/// Spacing where a frame holds too few particles to measure one: the default of a simulation's, m.
constexpr double kSpacingOfNothing = 0.05;

/// Keeps one frame in memory, and reads the next when it is asked for.
class ParticlePlayback : public core::ParticleSource {
 public:
  explicit ParticlePlayback(const v1::Scene& scene)
      : files_(frameFiles(scene.particle_file().path())), frame_(particleio::readParticleFile(files_.front())) {
    const v1::ParticleFile& settings = scene.particle_file();
    spacing_ = settings.particle_spacing();
    if (spacing_ == 0) spacing_ = medianNearestNeighbourDistance(frame_.positions);
    if (spacing_ == 0) spacing_ = kSpacingOfNothing;
    restDensity_ = settings.rest_density();
    takeOver(settings);
  }

  bool advance() override {
    if (!halted_.empty() || files_.size() == 1) return false;
    const bool last = index_ + 1 == files_.size();
    if (last && !loop_) return false;
    if (!show(last ? 0 : index_ + 1)) return false;
    // Goes on over the loop's seam: whoever paces the frames needs a time that never turns back.
    time_ += 1 / framesPerSecond_;
    return true;
  }

  double time() const override { return time_; }

  void reset() override {
    halted_.clear();
    time_ = 0;
    if (index_ != 0) show(0);
  }

  std::unique_ptr<core::ParticleSnapshot> snapshot() const override {
    auto snapshot = std::make_unique<core::ParticleSnapshot>();
    snapshot->time = time_;
    snapshot->spacing = spacing_;
    snapshot->restDensity = restDensity_;
    snapshot->positions = frame_.positions;
    snapshot->velocities = frame_.velocities;
    snapshot->densities = frame_.densities;
    snapshot->ids = frame_.ids;
    snapshot->pressures = frame_.pressures;
    snapshot->fluids = frame_.fluids;
    snapshot->bounds = core::boundsOf(frame_.positions);
    snapshot->statistics.steps = index_;
    snapshot->statistics.timeStepSeconds = files_.size() > 1 ? 1 / framesPerSecond_ : 0;
    snapshot->statistics.timeStepLimit = files_.size() > 1 ? "frames_per_second" : "";
    return snapshot;
  }

  void update(const v1::Scene& scene) override {
    SLUICE_CHECK(scene.has_particle_file());
    takeOver(scene.particle_file());
  }

  std::string halted() const override { return halted_; }

  core::Plan plan() const override {
    core::Plan plan = planOfStored(frame_);
    if (files_.size() > 1) {
      plan.stages.push_back(
          {"read frame", {"file"}, {"positions", "velocities", "densities", "ids", "pressures", "fluids"}});
    } else {
      plan.leftOut.insert(plan.leftOut.begin(), {"read frame", "a single file, which stays as it is"});
    }
    return plan;
  }

 private:
  void takeOver(const v1::ParticleFile& settings) {
    framesPerSecond_ = settings.frames_per_second();
    loop_ = settings.loop();
  }

  /// Where the file cannot be read, keeps the present frame and says why in `halted_`.
  bool show(std::size_t index) {
    try {
      frame_ = particleio::readParticleFile(files_[index]);
    } catch (const core::InputError& error) {
      halted_ = error.what();
      return false;
    }
    index_ = index;
    return true;
  }

  std::vector<fs::path> files_;
  particleio::ParticleFileData frame_;
  std::size_t index_ = 0;
  double time_ = 0;
  double spacing_ = 0;
  double restDensity_ = 0;
  double framesPerSecond_ = 0;
  bool loop_ = false;
  std::string halted_;
};

}  // namespace

std::unique_ptr<core::ParticleSource> openParticlePlayback(const v1::Scene& scene) {
  SLUICE_CHECK(scene.has_particle_file());
  return std::make_unique<ParticlePlayback>(scene);
}

}  // namespace sluice::sources
