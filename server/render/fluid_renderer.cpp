#include "sluice/render/fluid_renderer.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "data_traits.h"
#include "environment_picture.h"
#include "foam_dots.h"
#include "frame_passes.h"
#include "liquid_state.h"
#include "liquid_uniforms.h"
#include "picture_cover.h"
#include "same.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/gl/pass_clock.h"
#include "splat_target.h"
#include "study_pass.h"

namespace sluice::render {

namespace {

/// What of a scene shows in a picture, besides its particles.
v1::Scene withoutSource(const v1::Scene& scene) {
  v1::Scene rest;
  *rest.mutable_look() = scene.look();
  *rest.mutable_more_looks() = scene.more_looks();
  *rest.mutable_background() = scene.background();
  *rest.mutable_lighting() = scene.lighting();
  *rest.mutable_bodies() = scene.bodies();
  *rest.mutable_tone() = scene.tone();
  *rest.mutable_view() = scene.view();
  if (scene.has_foam()) *rest.mutable_foam() = scene.foam();
  return rest;
}

/// Pixels that hold every splat, however it is stretched.
PixelRect placeOf(const Eigen::AlignedBox3f& bounds, const SplatScale& scale, const ViewGeometry& view) {
  if (bounds.isEmpty()) return {};
  constexpr float kLargestInRadii = 4;
  const auto reach = Eigen::Vector3f::Constant(kLargestInRadii * scale.radius);
  PictureCover cover(view);
  cover.add(Eigen::AlignedBox3f(bounds.min() - reach, bounds.max() + reach));
  return cover.pixels();
}

}  // namespace

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
    if (isLastPicture(particles, scene, camera, size)) return keepPicture(particles, scene, view);

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
    const FramePlan plan = planFrame(scene, size, traits, reuse(scene, camera, size), device_);
    plan_ = plan.describe();
    targets_.fit(plan);

    setUpGl();
    passes_.bindLights(scene);
    environment_.bind();
    for (std::size_t k = 0; k < liquids_.size(); ++k) uploadSplats(plan, k, view);
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
    sceneOf_ = withoutSource(scene);
    cameraOf_ = camera;
    spacingOf_ = particles.spacing;
    bodiesOf_ = passes_.bodies().changes();
    hasBackground_ = plan.buffer(Resource::Background) != nullptr;
    hasPicture_ = true;
    hasLegend_ = plan.runs(Pass::Legend);
    pictureSize_ = size;
    return finish(particles, size);
  }

  void follow(const core::ParticleSnapshot& particles, const v1::Scene& scene) {
    takeParts(particles);
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
    hasBackground_ = hasPicture_ = false;
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
    const BufferId id{resource, static_cast<std::uint8_t>(isOfLiquid(resource) ? liquid : 0)};
    if (!targets_.has(id)) return {};
    const std::span<const float> values = targets_.read(id);
    return {targets_.size(id), {values.begin(), values.end()}};
  }

  RadiancePicture readRadiance() {
    const BufferId id{targets_.has({Resource::Picture}) ? Resource::Picture : Resource::Background};
    RadiancePicture picture{targets_.size(id), {}};
    picture.values.resize(4 * static_cast<std::size_t>(picture.size.width) *
                          static_cast<std::size_t>(picture.size.height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, targets_.framebuffer(id));
    glReadPixels(0, 0, picture.size.width, picture.size.height, GL_RGBA, GL_FLOAT, picture.values.data());
    return picture;
  }

 private:
  void checkSize(core::ImageSize size) const {
    if (size.width < 1 || size.height < 1 || size.width > maxEdge_ || size.height > maxEdge_) {
      throw core::InputError("", "",
                             "picture size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                                 " is outside 1x1 to " + std::to_string(maxEdge_) + "x" + std::to_string(maxEdge_));
    }
  }

  // --------------------------------------------------------------------------------------------- what can be kept

  bool isLastPicture(const core::ParticleSnapshot& particles, const v1::Scene& scene, const core::Camera& camera,
                     core::ImageSize size) const {
    return hasPicture_ && particles.sequence != 0 && particles.sequence == sequence_ &&
           particles.spacing == spacingOf_ && cameraOf_ == camera && pictureSize_ == size &&
           same(sceneOf_, withoutSource(scene));
  }

  bool sameSurroundings(const v1::Scene& scene) const {
    return same(sceneOf_.background(), scene.background()) && same(sceneOf_.lighting(), scene.lighting()) &&
           std::ranges::equal(sceneOf_.bodies(), scene.bodies(), same<v1::Body>);
  }

  ReuseTraits reuse(const v1::Scene& scene, const core::Camera& camera, core::ImageSize size) const {
    return {hasBackground_ && pictureSize_ == size && cameraOf_ == camera && sameSurroundings(scene) &&
                passes_.bodies().changes() == bodiesOf_,
            hasBackground_ && passes_.bodies().changes() == bodiesOf_};
  }

  /// The last frame's picture is still there.
  core::Frame keepPicture(const core::ParticleSnapshot& particles, const v1::Scene& scene, const ViewGeometry& view) {
    const FramePlan plan =
        planFrame(scene, view.size, {}, {.background = true, .picture = true, .legend = hasLegend_}, device_);
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
    takeParts(particles);
  }

  void takeParts(const core::ParticleSnapshot& particles) {
    const auto parts = splitByFluid(particles);
    liquids_.resize(parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (liquids_[k] == nullptr) liquids_[k] = std::make_unique<LiquidState>();
      liquids_[k]->particles = parts[k];
    }
  }

  // ------------------------------------------------------------------------------------------------ one liquid's part

  void aim(LiquidState& liquid, const v1::Look& look, const ViewGeometry& view, double spacing) {
    liquid.surfaceView = divided(view, look.smoothing().divisor());
    liquid.thicknessView = divided(view, look.thickness().divisor());
    liquid.scale = splatScale(look.splats(), spacing);
  }

  static void followViolence(LiquidState& liquid, const v1::Look& look) {
    if (look.has_noise()) {
      liquid.marks.follow(*liquid.particles, look.noise());
    } else {
      liquid.marks = {};
    }
  }

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

  void uploadSplats(const FramePlan& plan, std::size_t k, const ViewGeometry& view) {
    LiquidState& liquid = *liquids_[k];
    const SplatSelection& selection = liquid.selection;
    const auto sphere = [&](std::uint32_t index, float radius) {
      const Eigen::Vector3f centre = view.toView(liquid.particles->positions[index]);
      return ViewSphere{centre.x(), centre.y(), centre.z(), radius};
    };
    const bool ellipsoids = liquid.model.shape == SplatShape::Ellipsoid;
    const auto uploadPoints = [&](SplatArray& array, const SplatList& list) {
      ellipsoids ? array.upload(list.ellipsoids) : array.upload(list.spheres);
    };
    if (!device_.software && plan.runs(Pass::Splats, k)) uploadPoints(liquid.splats.visible, selection.visible);
    if (!device_.software && plan.runs(Pass::Thickness, k)) uploadPoints(liquid.splats.points, selection.points);
    if (plan.runs(Pass::LargeSplats, k) && ellipsoids) {
      std::vector<ViewEllipsoid> large;
      for (const std::uint32_t index : selection.large) large.push_back(toView(liquid.model.ellipsoids[index], view));
      liquid.splats.large.upload(large);
    } else if (plan.runs(Pass::LargeSplats, k)) {
      std::vector<ViewSphere> large;
      for (const std::uint32_t index : selection.large) {
        large.push_back(sphere(index, liquid.model.radius(index, liquid.scale.radius)));
      }
      liquid.splats.large.upload(large);
    }
    if (plan.runs(Pass::Spray, k)) {
      std::vector<ViewSphere> drops;
      for (const std::uint32_t index : selection.spray) drops.push_back(sphere(index, liquid.scale.dropRadius));
      // The farthest first: each is drawn over those behind it.
      std::ranges::stable_sort(drops, std::greater{}, &ViewSphere::z);
      liquid.splats.spray.upload(drops);
    }
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
  v1::Scene sceneOf_;  ///< Of the last picture, without its source.
  core::Camera cameraOf_;
  double spacingOf_ = 0;
  std::uint64_t bodiesOf_ = 0;  ///< Changes of the bodies until the last picture.
  bool hasBackground_ = false;
  bool hasPicture_ = false;
  bool hasLegend_ = false;       ///< Of the last picture.
  core::ImageSize pictureSize_;  ///< Of the last picture.
  v1::Scene studied_;            ///< The scene as its study view shows it.
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
