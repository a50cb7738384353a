#include "features/features_study.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <set>

#include "features/gates.h"
#include "machine.h"
#include "metrics/sight.h"
#include "sluice/core/input_error.h"
#include "sluice/gl/context.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/scene/convert.h"
#include "sluice/scene/scene.h"
#include "sluice/sources/column_and_sheet.h"
#include "smoothing/measure.h"
#include "study_scene.h"

namespace sluice::evaluate {

namespace {

constexpr core::ImageSize kSize{1024, 768};

constexpr float kShakeSpeed = 2;      ///< m/s, up or down.
constexpr double kFrameTime = 0.04;   ///< s; 2 m/s up and then down in it is violent for every look.
constexpr float kBodyStep = 0.002F;   ///< m in a frame.
constexpr std::size_t kFoam = 20000;  ///< Secondary particles.

/// What the bench cloud's source does not tell, and some features need: numbers, velocities, and foam over the sheet.
/// Other features do not look at them.
void complete(core::ParticleSnapshot& particles) {
  particles.ids.resize(particles.size());
  std::iota(particles.ids.begin(), particles.ids.end(), 0U);
  particles.velocities.assign(particles.size(), {0, kShakeSpeed, 0});
  core::DiffuseParticles& foam = particles.diffuse;
  const std::size_t stride = std::max<std::size_t>(particles.size() / kFoam, 1);
  for (std::size_t i = 0; i < particles.size() && foam.size() < kFoam; i += stride) {
    const Eigen::Vector3f& p = particles.positions[i];
    foam.positions.emplace_back(p.x(), p.y() + 0.02F, p.z());
    foam.velocities.emplace_back(Eigen::Vector3f::Zero());
    foam.kinds.push_back(static_cast<core::DiffuseKind>(foam.size() % 3));
    foam.remaining.push_back(1);
    foam.ids.push_back(static_cast<std::uint32_t>(foam.size()));
  }
}

/// One side of a comparison, with a renderer of its own, so that what it keeps is not lost to the other.
class Side {
 public:
  Side(gl::Context& context, const v1::Scene& scene, std::string_view assignments, Motion motion)
      : renderer_(context), scene_(scene), motion_(motion) {
    scene::assign(scene_, assignmentsOf(assignments));
    camera_ = scene::toCamera(scene_.camera());
    particles_ = sources::openColumnAndSheet(scene_)->snapshot();
    particles_->sequence = 1;
    complete(*particles_);
    if (motion_.twoLiquids) {
      constexpr float kColumn = 0.5F;  // m; where it ends and the sheet begins
      for (const Eigen::Vector3f& position : particles_->positions) {
        particles_->fluids.push_back(position.x() < kColumn ? 1 : 0);
      }
    }
    if (motion_.bodies) {
      for (const v1::Body& body : scene_.bodies()) {
        particles_->bodies.push_back({scene::toVector(body.position()).cast<float>(), Eigen::Quaternionf::Identity()});
      }
    }
  }

  void draw() {
    using Clock = std::chrono::steady_clock;
    if (motion_.camera) camera_ = turned(camera_, kTurnDegrees);
    if (motion_.particles) shake();
    if (motion_.bodies) moveBodies();
    const auto start = Clock::now();
    renderer_.render(*particles_, scene_, camera_, kSize);
    milliseconds_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    std::int64_t bytes = 0;
    for (const core::PlannedBuffer& buffer : renderer_.plan().buffers) bytes += static_cast<std::int64_t>(buffer.bytes);
    bytes_ = std::max(bytes_, bytes);
    for (const core::PlannedStage& stage : renderer_.plan().stages) passes_.insert(stage.name);
  }

  /// Of all frames but the first, which warms up.
  double milliseconds() const { return median({milliseconds_.begin() + 1, milliseconds_.end()}); }

  /// Of the frame that needed most: one that is kept from before names no buffers, but stands in them.
  std::int64_t bytes() const { return bytes_; }

  /// Of all frames.
  const std::set<std::string>& passes() const { return passes_; }

 private:
  void shake() {
    ++particles_->sequence;
    particles_->time += kFrameTime;
    for (Eigen::Vector3f& velocity : particles_->velocities) velocity = -velocity;
  }

  void moveBodies() {
    ++particles_->sequence;
    for (core::BodyPose& pose : particles_->bodies) pose.position.x() += kBodyStep;
  }

  render::FluidRenderer renderer_;
  v1::Scene scene_;
  Motion motion_;
  core::Camera camera_;
  std::unique_ptr<core::ParticleSnapshot> particles_;
  std::vector<double> milliseconds_;
  std::set<std::string> passes_;
  std::int64_t bytes_ = 0;
};

/// Assignments of both sides, those of one, and what moves.
std::string describe(std::string_view both, std::string_view assignments, Motion motion) {
  std::string text(both);
  if (!both.empty() && !assignments.empty()) text += ' ';
  text += assignments;
  const auto add = [&](const char* words) { text += (text.empty() ? "" : ", ") + std::string(words); };
  if (motion.camera) add("camera turns");
  if (motion.particles) add("new particles");
  if (motion.bodies) add("bodies move");
  if (motion.twoLiquids) add("two liquids");
  if (!motion.camera && !motion.particles && !motion.bodies) add("all still");
  return text;
}

/// Passes that run with the feature alone, with a comma between.
std::string passesOf(const Side& inUse, const Side& leftOut) {
  std::string text;
  for (const std::string& pass : inUse.passes()) {
    if (!leftOut.passes().contains(pass)) text += (text.empty() ? "" : ", ") + pass;
  }
  return text;
}

Row measure(gl::Context& context, const Options& options, const Gate& gate) {
  v1::Scene scene = shippedScene(options, "column_and_sheet");
  scene::assign(scene, assignmentsOf(gate.both));
  Side inUse(context, scene, gate.inUse, gate.motionInUse);
  Side leftOut(context, scene, gate.leftOut, gate.motionLeftOut);
  const int frames = options.quick ? 7 : 21;
  // In turn, so that what else the machine does strikes both alike.
  for (int i = 0; i <= frames; ++i) {
    inUse.draw();
    leftOut.draw();
  }
  return {{"feature", std::string(gate.feature)},
          {"in_use", describe(gate.both, gate.inUse, gate.motionInUse)},
          {"left_out", describe(gate.both, gate.leftOut, gate.motionLeftOut)},
          {"passes", passesOf(inUse, leftOut)},
          {"milliseconds_in_use", inUse.milliseconds()},
          {"milliseconds_left_out", leftOut.milliseconds()},
          {"ratio", inUse.milliseconds() / std::max(leftOut.milliseconds(), 1e-6)},
          {"milliseconds_saved", inUse.milliseconds() - leftOut.milliseconds()},
          {"bytes_in_use", inUse.bytes()},
          {"bytes_left_out", leftOut.bytes()},
          {"bytes_saved", inUse.bytes() - leftOut.bytes()}};
}

}  // namespace

std::vector<std::string> featureParts() {
  std::vector<std::string> parts;
  for (const Gate& gate : gates()) parts.emplace_back(gate.feature);
  return parts;
}

Report runFeaturesStudy(const Options& options) {
  const std::unique_ptr<gl::Context> context = gl::Context::create();
  Report report;
  Table table{"features", {}};
  for (const Gate& gate : gates()) {
    if (!options.only.empty() && options.only != gate.feature) continue;
    options.tell(std::string(gate.feature));
    table.rows.push_back(measure(*context, options, gate));
  }
  std::string page = "# What leaving out saves\n\ncolumn_and_sheet, 64,000 particles, 1024×768, the default look; " +
                     machineName(*context) +
                     ". Medians of frames drawn in turn. New particles are those of before, shaken; where foam is on, "
                     "it is of 20,000 particles.\n\n";
  page += toMarkdown(table.rows, {{"feature", "feature"},
                                  {"in_use", "in use"},
                                  {"left_out", "left out"},
                                  {"passes", "passes left out"},
                                  {"milliseconds_in_use", "ms in use"},
                                  {"milliseconds_left_out", "ms left out"},
                                  {"ratio", "ratio"},
                                  {"milliseconds_saved", "ms saved"},
                                  {"bytes_saved", "bytes saved"}});
  report.documents.push_back({"features.md", std::move(page)});
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace sluice::evaluate
