#include "sluice/render/fluid_renderer.h"

#include <algorithm>
#include <array>
#include <string>

#include "data_traits.h"
#include "environment_picture.h"
#include "foam_dots.h"
#include "frame_passes.h"
#include "last_picture.h"
#include "liquid_state.h"
#include "liquid_uniforms.h"
#include "liquid_update.h"
#include "read_back.h"
#include "same.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/gl/pass_clock.h"
#include "splat_target.h"
#include "study_pass.h"
#include "upload_splats.h"

namespace sluice::render {

class FluidRenderer::Impl {
 public:
  Impl(gl::Context& context, const DeviceTraits& device)
      : device_(device),
        clock_(context.isSoftware()),
        emptyArray_(gl::makeVertexArray()),
        maxPointPixels_(maxPointPixels()) {
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &maxEdge_);
  }

  core::Frame render(const core::ParticleSnapshot& particles, const v1::Scene& given, const core::Camera& camera,
                     core::ImageSize size) {
    checkSize(size);
    if (isStudy(given.view())) studied_ = forItsView(given);
    const v1::Scene& scene = isStudy(given.view()) ? studied_ : given;
    const ViewGeometry view = makeViewGeometry(camera, size);
    clock_.start();
    const bool seen = particles.sequence != 0 && particles.sequence == sequence_;
    if (seen && last_.shows(particles.spacing, scene, camera, size)) return keepPicture(particles, scene, view);

    environment_.update(scene);
    clock_.lap("environment");
    noteParticles(particles);
    passes_.setBodies(scene, particles.bodies);
    bodyPlaces_ = placesInPicture(passes_.bodies(), view);
    shadedFloor_ = shadedFloor(passes_.bodies(), scene, view);
    std::vector<DataTraits> traits;
    for (std::size_t k = 0; k < liquids_.size(); ++k)
      traits.push_back(select(*liquids_[k], lookOf(scene, k), scene, view));
    clock_.lap(name(Pass::SelectSplats));
    foam_.clear();
    if (scene.has_foam() && particles.diffuse.size() > 0) {
      foam_ = makeFoamDots(particles.diffuse, scene, particles.spacing, view);
      traits.front().foamDots = foam_.size();
      clock_.lap("select foam");
    }
    const FramePlan plan =
        planFrame(scene, size, traits, last_.reuse(scene, camera, size, passes_.bodies().changes()), device_);
    plan_ = plan.describe();
    targets_.fit(plan);

    setUpGl();
    passes_.bindLights(scene);
    environment_.bind();
    for (std::size_t k = 0; k < liquids_.size(); ++k) uploadSplats(*liquids_[k], k, plan, view, device_);
    if (plan.runs(Pass::Sunlight)) light_.update(particles, scene, liquids_.size());
    passes_.setLight(light_);
    clock_.lap("light map");
    uploadUniforms(plan, scene, view);
    clock_.lap("upload");
    for (const PassStep& step : plan.steps) {
      if (step.pass == Pass::SelectSplats) continue;  // ran above: the plan depends on it
      run(step.pass, contextOf(step, plan, scene, view));
      clock_.lap(step.name);
    }
    last_.note(plan, particles.spacing, scene, camera, size, passes_.bodies().changes());
    return finish(particles, size);
  }

  void follow(const core::ParticleSnapshot& particles, const v1::Scene& scene) {
    takeParts(liquids_, particles);
    for (std::size_t k = 0; k < liquids_.size(); ++k) followViolence(*liquids_[k], lookOf(scene, k));
    // Not owned where it is not split, and gone by the next frame.
    if (liquids_.size() == 1) liquids_.front()->particles.reset();
  }

  FloatPicture smooth(const FloatPicture& surface, const v1::Look& given, double spacing, const core::Camera& camera) {
    checkSize(surface.size);
    v1::Scene scene;
    *scene.mutable_look() = given;
    scene.mutable_look()->mutable_smoothing()->set_divisor(1);
    const ViewGeometry view = makeViewGeometry(camera, surface.size);
    DataTraits traits;
    traits.spacing = spacing;
    traits.points = 1;
    traits.pixelSlope = view.pixelSlope;
    const float largest = std::ranges::max(surface.values);
    traits.nearestDepth = largest > 0.0F ? 1.0F / largest : 1.0F;
    const FramePlan plan = planFrame(scene, surface.size, std::array{traits}, {}, device_);
    last_.forget();
    targets_.fit(plan);
    setUpGl();
    if (liquids_.empty()) liquids_.push_back(std::make_unique<LiquidState>());
    aim(*liquids_[0], scene.look(), view, spacing);
    liquids_[0]->place = {0, 0, surface.size.width, surface.size.height};
    uploadUniforms(plan, scene, view);
    std::ranges::copy(surface.values, targets_.startAnew({Resource::Surface}).begin());
    for (const PassStep& step : plan.steps) {
      if (step.pass != Pass::Mask && step.pass != Pass::Smoothing) continue;
      run(step.pass, contextOf(step, plan, scene, view));
    }
    return readBuffer(Resource::Surface, 0);
  }

  const core::Plan& plan() const { return plan_; }

  FloatPicture readBuffer(Resource resource, std::size_t liquid) {
    return readValues(targets_, {resource, static_cast<std::uint8_t>(isOfLiquid(resource) ? liquid : 0)});
  }

  RadiancePicture readRadiance() { return render::readRadiance(targets_); }

 private:
  void checkSize(core::ImageSize size) const {
    if (size.width < 1 || size.height < 1 || size.width > maxEdge_ || size.height > maxEdge_) {
      throw core::InputError("", "",
                             "picture size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                                 " is outside 1x1 to " + std::to_string(maxEdge_) + "x" + std::to_string(maxEdge_));
    }
  }

  // --------------------------------------------------------------------------------------------- what can be kept

  /// The last frame's picture is still there.
  core::Frame keepPicture(const core::ParticleSnapshot& particles, const v1::Scene& scene, const ViewGeometry& view) {
    const FramePlan plan =
        planFrame(scene, view.size, {}, {.background = true, .picture = true, .legend = last_.hasLegend()}, device_);
    plan_ = plan.describe();
    for (const PassStep& step : plan.steps) {
      run(step.pass, contextOf(step, plan, scene, view));
      clock_.lap(step.name);
    }
    return finish(particles, view.size);
  }

  void noteParticles(const core::ParticleSnapshot& particles) {
    // Sequence numbers never repeat; 0 is a snapshot that has not got one.
    newParticles_ = particles.sequence == 0 || particles.sequence != sequence_ || liquids_.empty();
    sequence_ = particles.sequence;
    if (!newParticles_ && liquids_.size() > 1) return;
    takeParts(liquids_, particles);
  }

  // ------------------------------------------------------------------------------------------------ one liquid's part

  DataTraits select(LiquidState& liquid, const v1::Look& look, const v1::Scene& scene, const ViewGeometry& view) {
    const core::ParticleSnapshot& particles = *liquid.particles;
    aim(liquid, look, view, particles.spacing);
    if (newParticles_) liquid.bounds = core::boundsOf(particles.positions);
    liquid.place = placeOf(liquid.bounds, liquid.scale, liquid.surfaceView);
    if (newParticles_ || !same(liquid.splatsOfModel, look.splats())) {
      liquid.model = makeSplatModel(particles, look.splats(), liquid.model);
      liquid.splatsOfModel = look.splats();
      clock_.lap("model splats");
    }
    if (newParticles_) followViolence(liquid, look);
    const SplatScale& scale = liquid.scale;
    liquid.selection = selectSplats(particles.positions, liquid.model, view,
                                    {scale.radius, scale.dropRadius, scale.nearDepth, maxPointPixels_});
    DataTraits traits = dataTraits(particles, liquid.selection, scale, view, look);
    liquid.mirror = BodyMirror::of(particles, look.liquid(), scene, passes_.bodies(), view.eye);
    traits.cubeMap = liquid.cube.shows({liquid.mirror.middle, static_cast<int>(look.liquid().cube_map().edge()),
                                        passes_.bodies().changes(), scene.background()});
    return traits;
  }

  // ------------------------------------------------------------------------------------------------------- the frame

  void setUpGl() {
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  }

  void uploadUniforms(const FramePlan& plan, const v1::Scene& scene, const ViewGeometry& view) {
    const auto upload = [&](gl::StreamBuffer& buffer, const auto& uniforms) {
      buffer.upload(std::as_bytes(std::span(&uniforms, 1)));
    };
    const auto frameUniforms = [&](const ViewGeometry& target) {
      FrameUniforms uniforms = makeFrameUniforms(target, view, scene);
      environment_.ambient().pack(uniforms);
      placeLightMap(uniforms, light_.map().grid);
      return uniforms;
    };
    uniforms_ = frameUniforms(view);
    upload(pictureUniforms_, uniforms_);
    for (std::size_t k = 0; k < liquids_.size(); ++k) {
      LiquidState& liquid = *liquids_[k];
      upload(liquid.surfaceUniforms, frameUniforms(liquid.surfaceView));
      liquid.backView = divided(view, plan.surfaces[k].backDivisor);
      if (plan.runs(Pass::BackSplats, k)) upload(liquid.backUniforms, frameUniforms(liquid.backView));
      upload(liquid.liquidUniforms, makeLiquidUniforms(liquid.surfaceView, liquid.thicknessView, liquid.scale,
                                                       plan.surfaces[k], liquid.mirror, lookOf(scene, k)));
    }
  }

  FrameContext contextOf(const PassStep& step, const FramePlan& plan, const v1::Scene& scene,
                         const ViewGeometry& view) {
    static const core::ParticleSnapshot kNoParticles;
    LiquidState& liquid = *liquids_[step.liquid];
    const bool ofBack = step.pass == Pass::BackSplats || step.pass == Pass::BackSmoothing;
    return {plan,
            scene,
            view,
            pictureUniforms_.name(),
            bodyPlaces_,
            shadedFloor_,
            uniforms_,
            raster_,
            foam_,
            LiquidTargets(targets_, step.liquid),
            step.liquid,
            step.layer,
            liquid.particles ? *liquid.particles : kNoParticles,
            lookOf(scene, step.liquid),
            ofBack ? liquid.backView : liquid.surfaceView,
            liquid.thicknessView,
            liquid.scale,
            liquid.model.shape,
            liquid.model,
            liquid.selection,
            liquid.splats,
            liquid.mirror,
            liquid.cube,
            liquid.place,
            ofBack ? liquid.backUniforms.name() : liquid.surfaceUniforms.name(),
            liquid.liquidUniforms.name(),
            liquid.marks.violence()};
  }

  void run(Pass pass, const FrameContext& frame) {
    glBindVertexArray(emptyArray_.name());
    passes_.run(pass, frame);
  }

  core::Frame finish(const core::ParticleSnapshot& particles, core::ImageSize size) {
    core::Frame picture;
    picture.size = size;
    picture.pixels = passes_.takePixels();
    for (const core::StageTime& stage : clock_.finish()) {
      core::addStageTime(picture.tag.stages, stage.name, stage.milliseconds);
    }
    picture.tag.snapshotSequence = particles.sequence;
    picture.tag.simulationTime = particles.time;
    // A snapshot that is not split is the caller's, and may be gone by the next frame.
    if (liquids_.size() == 1) liquids_.front()->particles.reset();
    return picture;
  }

  DeviceTraits device_;
  gl::PassClock clock_;
  gl::VertexArray emptyArray_;
  float maxPointPixels_;
  GLint maxEdge_ = 0;

  FrameTargets targets_;
  std::vector<std::unique_ptr<LiquidState>> liquids_;
  SplatRaster raster_;
  std::vector<FoamDot> foam_;  ///< Of the frame at hand.
  gl::StreamBuffer pictureUniforms_;
  std::vector<PixelRect> bodyPlaces_;
  std::vector<PixelRect> shadedFloor_;
  FrameUniforms uniforms_{};
  core::Plan plan_;

  std::uint64_t sequence_ = 0;
  bool newParticles_ = false;
  LastPicture last_;
  v1::Scene studied_;  ///< The scene as its study view shows it.
  EnvironmentState environment_;
  KeptLightMap light_;

  FramePasses passes_;
};

FluidRenderer::FluidRenderer(gl::Context& context) : FluidRenderer(context, {.software = context.isSoftware()}) {}
FluidRenderer::FluidRenderer(gl::Context& context, const DeviceTraits& device)
    : impl_(std::make_unique<Impl>(context, device)) {}
FluidRenderer::~FluidRenderer() = default;

core::Frame FluidRenderer::render(const core::ParticleSnapshot& particles, const v1::Scene& scene,
                                  const core::Camera& camera, core::ImageSize size) {
  return impl_->render(particles, scene, camera, size);
}

void FluidRenderer::follow(const core::ParticleSnapshot& particles, const v1::Scene& scene) {
  impl_->follow(particles, scene);
}

FloatPicture FluidRenderer::readBuffer(Resource resource, std::size_t liquid) {
  return impl_->readBuffer(resource, liquid);
}

RadiancePicture FluidRenderer::readRadiance() { return impl_->readRadiance(); }

FloatPicture FluidRenderer::smooth(const FloatPicture& surface, const v1::Look& look, double spacing,
                                   const core::Camera& camera) {
  return impl_->smooth(surface, look, spacing, camera);
}

const core::Plan& FluidRenderer::plan() const { return impl_->plan(); }

}  // namespace sluice::render
