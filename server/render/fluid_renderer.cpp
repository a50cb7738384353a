#include "sluice/render/fluid_renderer.h"

#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <functional>
#include <string>

#include "data_traits.h"
#include "frame_context.h"
#include "passes.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/gl/pass_clock.h"
#include "splat_target.h"

namespace sluice::render {

namespace {

template <class Message>
bool same(const Message& a, const Message& b) {
  return google::protobuf::util::MessageDifferencer::Equals(a, b);
}

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

  core::Frame render(const core::ParticleSnapshot& particles, const v1::Scene& scene, const core::Camera& camera,
                     core::ImageSize size) {
    checkSize(size);
    const v1::Look& look = scene.look();
    const ViewGeometry view = makeViewGeometry(camera, size);
    const ViewGeometry surfaceView = divided(view, look.smoothing().divisor());
    const ViewGeometry thicknessView = divided(view, look.thickness().divisor());
    const SplatScale scale = splatScale(look.splats(), particles.spacing);

    clock_.start();
    if (isLastPicture(particles, scene, camera, size)) return keepPicture(particles, scene, size);
    noteParticles(particles);
    modelSplats(particles, look.splats());
    const SplatSelection selection = selectSplats(particles.positions, model_, view,
                                                  {scale.radius, scale.dropRadius, scale.nearDepth, maxPointPixels_});
    clock_.lap(name(Pass::SelectSplats));
    const FramePlan plan =
        planFrame(scene, size, dataTraits(particles, selection, scale, view), reuse(scene, camera, size), device_);
    plan_ = plan.describe();
    targets_.fit(plan);

    setUpGl();
    uploadSplats(plan, particles, selection, view, scale);
    castShadowIfNeeded(plan, particles, scene);
    upload(pictureUniforms_, makeFrameUniforms(view, view, thicknessView, scale, plan, scene));
    upload(surfaceUniforms_, makeFrameUniforms(surfaceView, view, thicknessView, scale, plan, scene));
    clock_.lap("upload");

    const FrameContext frame{plan,
                             view,
                             surfaceView,
                             thicknessView,
                             scale,
                             scene,
                             look,
                             model_.shape,
                             selection,
                             targets_,
                             splats_,
                             raster_,
                             pictureUniforms_.name(),
                             surfaceUniforms_.name()};
    for (const PassStep& step : plan.steps) {
      if (step.pass == Pass::SelectSplats) continue;  // ran above: the plan depends on it
      glBindVertexArray(emptyArray_.name());
      run(step.pass, frame);
      clock_.lap(step.name);
    }
    sceneOf_ = withoutSource(scene);
    cameraOf_ = camera;
    spacingOf_ = particles.spacing;
    hasBackground_ = true;
    hasPicture_ = true;
    pictureIs_ = plan.buffer(Resource::Picture) != nullptr ? Resource::Picture : Resource::Background;
    return finish(particles, size);
  }

  FloatPicture smooth(const FloatPicture& surface, const v1::Look& given, double spacing, const core::Camera& camera) {
    checkSize(surface.size);
    v1::Scene scene;
    v1::Look& look = *scene.mutable_look();
    look = given;
    look.mutable_smoothing()->set_divisor(1);
    const ViewGeometry view = makeViewGeometry(camera, surface.size);
    const SplatScale scale = splatScale(look.splats(), spacing);
    DataTraits traits;
    traits.spacing = spacing;
    traits.points = 1;
    traits.pixelSlope = view.pixelSlope;
    const float largest = std::ranges::max(surface.values);
    traits.nearestDepth = largest > 0.0F ? 1.0F / largest : 1.0F;
    const FramePlan plan = planFrame(scene, surface.size, traits, {}, device_);
    hasBackground_ = hasPicture_ = false;
    targets_.fit(plan);
    setUpGl();
    upload(pictureUniforms_, makeFrameUniforms(view, view, view, scale, plan, scene));
    std::ranges::copy(surface.values, targets_.startAnew(Resource::Surface).begin());
    const FrameContext frame{plan,
                             view,
                             view,
                             view,
                             scale,
                             scene,
                             look,
                             SplatShape::Sphere,
                             {},
                             targets_,
                             splats_,
                             raster_,
                             pictureUniforms_.name(),
                             pictureUniforms_.name()};
    for (const Pass pass : {Pass::Mask, Pass::Smoothing}) {
      glBindVertexArray(emptyArray_.name());
      if (plan.runs(pass)) run(pass, frame);
    }
    return readBuffer(Resource::Surface);
  }

  const core::Plan& plan() const { return plan_; }

  void show(View view) {
    composite_.show(view);
    spray_.show(view);
    hasPicture_ = false;
  }

  FloatPicture readBuffer(Resource resource) {
    if (!targets_.has(resource)) return {};
    const std::span<const float> values = targets_.read(resource);
    return {targets_.size(resource), {values.begin(), values.end()}};
  }

 private:
  void checkSize(core::ImageSize size) const {
    if (size.width < 1 || size.height < 1 || size.width > maxEdge_ || size.height > maxEdge_) {
      throw core::InputError("", "",
                             "picture size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                                 " is outside 1x1 to " + std::to_string(maxEdge_) + "x" + std::to_string(maxEdge_));
    }
  }

  bool isLastPicture(const core::ParticleSnapshot& particles, const v1::Scene& scene, const core::Camera& camera,
                     core::ImageSize size) const {
    return hasPicture_ && particles.sequence != 0 && particles.sequence == sequence_ &&
           particles.spacing == spacingOf_ && cameraOf_ == camera && targets_.size(Resource::Background) == size &&
           same(sceneOf_, withoutSource(scene));
  }

  /// The last frame's picture is still there.
  core::Frame keepPicture(const core::ParticleSnapshot& particles, const v1::Scene& scene, core::ImageSize size) {
    plan_ = planFrame(scene, size, {}, {.background = true, .picture = true}, device_).describe();
    return finish(particles, size);
  }

  core::Frame finish(const core::ParticleSnapshot& particles, core::ImageSize size) {
    core::Frame picture = readBack(size);
    clock_.lap("read back");
    for (const core::StageTime& stage : clock_.finish()) {
      core::addStageTime(picture.tag.stages, stage.name, stage.milliseconds);
    }
    picture.tag.snapshotSequence = particles.sequence;
    picture.tag.simulationTime = particles.time;
    return picture;
  }

  void noteParticles(const core::ParticleSnapshot& particles) {
    // Sequence numbers never repeat; 0 is a snapshot that has not got one.
    newParticles_ = particles.sequence == 0 || particles.sequence != sequence_;
    sequence_ = particles.sequence;
  }

  void modelSplats(const core::ParticleSnapshot& particles, const v1::Splats& splats) {
    if (!newParticles_ && same(splatsOfModel_, splats)) return;
    model_ = makeSplatModel(particles, splats, model_);
    splatsOfModel_ = splats;
    clock_.lap("model splats");
  }

  void uploadSplats(const FramePlan& plan, const core::ParticleSnapshot& particles, const SplatSelection& selection,
                    const ViewGeometry& view, const SplatScale& scale) {
    const auto sphere = [&](std::uint32_t index, float radius) {
      const Eigen::Vector3f centre = view.toView(particles.positions[index]);
      return ViewSphere{centre.x(), centre.y(), centre.z(), radius};
    };
    const bool ellipsoids = model_.shape == SplatShape::Ellipsoid;
    const auto uploadPoints = [&](SplatArray& array, const SplatList& list) {
      ellipsoids ? array.upload(list.ellipsoids) : array.upload(list.spheres);
    };
    if (!device_.software && plan.runs(Pass::Splats)) uploadPoints(splats_.visible, selection.visible);
    if (!device_.software && plan.runs(Pass::Thickness)) uploadPoints(splats_.points, selection.points);
    if (plan.runs(Pass::LargeSplats) && ellipsoids) {
      std::vector<ViewEllipsoid> large;
      for (const std::uint32_t index : selection.large) large.push_back(toView(model_.ellipsoids[index], view));
      splats_.large.upload(large);
    } else if (plan.runs(Pass::LargeSplats)) {
      std::vector<ViewSphere> large;
      for (const std::uint32_t index : selection.large) {
        large.push_back(sphere(index, model_.radius(index, scale.radius)));
      }
      splats_.large.upload(large);
    }
    if (plan.runs(Pass::Spray)) {
      std::vector<ViewSphere> drops;
      for (const std::uint32_t index : selection.spray) drops.push_back(sphere(index, scale.dropRadius));
      // The farthest first: each is drawn over those behind it.
      std::ranges::stable_sort(drops, std::greater{}, &ViewSphere::z);
      splats_.spray.upload(drops);
    }
  }

  ReuseTraits reuse(const v1::Scene& scene, const core::Camera& camera, core::ImageSize size) const {
    return {hasBackground_ && targets_.size(Resource::Background) == size && cameraOf_ == camera &&
            sameSurroundings(scene)};
  }

  bool sameSurroundings(const v1::Scene& scene) const {
    return same(sceneOf_.background(), scene.background()) && same(sceneOf_.lighting(), scene.lighting()) &&
           std::ranges::equal(sceneOf_.bodies(), scene.bodies(), same<v1::Body>);
  }

  void setUpGl() {
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  }

  void castShadowIfNeeded(const FramePlan& plan, const core::ParticleSnapshot& particles, const v1::Scene& scene) {
    newShadow_ = false;
    if (!plan.runs(Pass::GroundShadow)) return;
    // Of these particles, and not of some that came while no shadow was in the picture.
    if (!newParticles_ && shadowSequence_ == sequence_ && sameSurroundings(scene)) return;
    shadow_ = castShadow(particles.positions, static_cast<float>(particles.spacing),
                         static_cast<float>(scene.background().floor_height()), sunDirection(scene.lighting().sun()));
    newShadow_ = true;
    shadowSequence_ = sequence_;
  }

  void upload(gl::StreamBuffer& buffer, FrameUniforms uniforms) const {
    uniforms.shadow[1] = shadow_.corner.x();
    uniforms.shadow[2] = shadow_.corner.y();
    uniforms.shadow[3] = shadow_.edge;
    buffer.upload(std::as_bytes(std::span(&uniforms, 1)));
  }

  void run(Pass pass, const FrameContext& frame) {
    switch (pass) {
      case Pass::Background:
        background_.run(frame);
        break;
      case Pass::GroundShadow:
        groundShadow_.run(frame, shadow_, newShadow_);
        break;
      case Pass::Splats:
        splatsPass_.runPoints(frame);
        break;
      case Pass::LargeSplats:
        splatsPass_.runLarge(frame);
        break;
      case Pass::Mask:
        mask_.run(frame);
        break;
      case Pass::Smoothing:
        smoothing_.run(frame);
        break;
      case Pass::Thickness:
        thickness_.runPoints(frame);
        break;
      case Pass::LargeThickness:
        thickness_.runLarge(frame);
        break;
      case Pass::SmoothThickness:
        smoothThickness_.run(frame);
        break;
      case Pass::Composite:
        composite_.run(frame);
        break;
      case Pass::BlendLiquid:
        blendLiquid_.run(frame);
        break;
      case Pass::Spray:
        spray_.run(frame);
        break;
      default:
        break;
    }
  }

  core::Frame readBack(core::ImageSize size) {
    core::Frame picture;
    picture.size = size;
    picture.pixels.resize(4 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, targets_.framebuffer(pictureIs_));
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, picture.pixels.data());
    return picture;
  }

  DeviceTraits device_;
  gl::PassClock clock_;
  gl::VertexArray emptyArray_;
  float maxPointPixels_;
  GLint maxEdge_ = 0;

  FrameTargets targets_;
  SplatModel model_;
  v1::Splats splatsOfModel_;
  SplatBuffers splats_;
  SplatRaster raster_;
  gl::StreamBuffer pictureUniforms_;
  gl::StreamBuffer surfaceUniforms_;
  core::Plan plan_;

  std::uint64_t sequence_ = 0;
  bool newParticles_ = false;
  v1::Scene sceneOf_;  ///< Of the last picture, without its source.
  core::Camera cameraOf_;
  double spacingOf_ = 0;
  bool hasBackground_ = false;
  bool hasPicture_ = false;
  Resource pictureIs_ = Resource::Picture;
  ShadowMap shadow_;
  std::uint64_t shadowSequence_ = 0;
  bool newShadow_ = false;

  BackgroundPass background_;
  GroundShadowPass groundShadow_;
  SplatsPass splatsPass_;
  MaskPass mask_;
  SmoothingPass smoothing_;
  ThicknessPass thickness_;
  SmoothThicknessPass smoothThickness_;
  CompositePass composite_;
  BlendLiquidPass blendLiquid_;
  SprayPass spray_;
};

FluidRenderer::FluidRenderer(gl::Context& context) : FluidRenderer(context, {.software = context.isSoftware()}) {}
FluidRenderer::FluidRenderer(gl::Context& context, const DeviceTraits& device)
    : impl_(std::make_unique<Impl>(context, device)) {}
FluidRenderer::~FluidRenderer() = default;

core::Frame FluidRenderer::render(const core::ParticleSnapshot& particles, const v1::Scene& scene,
                                  const core::Camera& camera, core::ImageSize size) {
  return impl_->render(particles, scene, camera, size);
}

void FluidRenderer::show(View view) { impl_->show(view); }

FloatPicture FluidRenderer::readBuffer(Resource resource) { return impl_->readBuffer(resource); }

FloatPicture FluidRenderer::smooth(const FloatPicture& surface, const v1::Look& look, double spacing,
                                   const core::Camera& camera) {
  return impl_->smooth(surface, look, spacing, camera);
}

const core::Plan& FluidRenderer::plan() const { return impl_->plan(); }

}  // namespace sluice::render
