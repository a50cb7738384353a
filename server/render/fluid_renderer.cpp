#include "sluice/render/fluid_renderer.h"

#include <google/protobuf/util/message_differencer.h>

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

}  // namespace

class FluidRenderer::Impl {
 public:
  explicit Impl(gl::Context& context)
      : clock_(context.isSoftware()), emptyArray_(gl::makeVertexArray()), maxPointPixels_(maxPointPixels()) {
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &maxEdge_);
  }

  core::Frame render(const core::ParticleSnapshot& particles, const v1::Look& look, const v1::Background& background,
                     const core::Camera& camera, core::ImageSize size) {
    checkSize(size);
    const ViewGeometry view = makeViewGeometry(camera, size);
    const SplatScale scale = splatScale(look.splats(), particles.spacing);

    core::StageTimes cpuStages;
    clock_.start();
    upload(particles);
    DataTraits traits;
    {
      const core::StageTimer timer(cpuStages, name(Pass::SelectSplats));
      traits = select(particles, view, scale);
    }
    const FramePlan plan = planFrame(look, background, size, traits, reuse(background, camera, size));
    plan_ = plan.describe();
    targets_.fit(plan);

    setUpGl();
    castShadowIfNeeded(plan, particles, background);
    uploadUniforms(makeFrameUniforms(view, scale, look, background));
    clear(plan);
    clock_.lap("upload");

    const FrameContext frame{plan, view, scale, look, background, targets_, splats_};
    for (const PassStep& step : plan.steps) {
      if (step.pass == Pass::SelectSplats) continue;  // ran above: the plan depends on it
      glBindVertexArray(emptyArray_.name());
      run(step.pass, frame);
      clock_.lap(name(step.pass));
    }
    core::Frame picture = readBack(plan, size);
    clock_.lap("read back");

    backgroundOf_ = background;
    cameraOfBackground_ = camera;
    picture.tag.stages = std::move(cpuStages);
    for (const core::StageTime& stage : clock_.finish()) {
      core::addStageTime(picture.tag.stages, stage.name, stage.milliseconds);
    }
    picture.tag.snapshotSequence = particles.sequence;
    picture.tag.simulationTime = particles.time;
    return picture;
  }

  const core::Plan& plan() const { return plan_; }

  void show(View view) { composite_.show(view); }

  FloatPicture readBuffer(Resource resource) const {
    FloatPicture picture;
    if (!targets_.has(resource)) return picture;
    picture.size = targets_.size(resource);
    picture.values.resize(static_cast<std::size_t>(picture.size.width) * static_cast<std::size_t>(picture.size.height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, targets_.framebuffer(resource));
    glReadPixels(0, 0, picture.size.width, picture.size.height, GL_RED, GL_FLOAT, picture.values.data());
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

  void upload(const core::ParticleSnapshot& particles) {
    // Sequence numbers never repeat; 0 is a snapshot that has not got one.
    newParticles_ = particles.sequence == 0 || particles.sequence != uploadedSequence_;
    uploadedSequence_ = particles.sequence;
    if (newParticles_) splats_.uploadPositions(particles.positions);
  }

  DataTraits select(const core::ParticleSnapshot& particles, const ViewGeometry& view, const SplatScale& scale) {
    const SplatSelection selection =
        selectSplats(particles.positions, view, {scale.radius, scale.nearDepth, maxPointPixels_});
    splats_.uploadSelection(selection, particles.positions);
    return dataTraits(selection, scale, view);
  }

  ReuseTraits reuse(const v1::Background& background, const core::Camera& camera, core::ImageSize size) const {
    return {targets_.has(Resource::Background) && targets_.size(Resource::Background) == size &&
            cameraOfBackground_ == camera && same(backgroundOf_, background)};
  }

  void setUpGl() {
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  }

  void castShadowIfNeeded(const FramePlan& plan, const core::ParticleSnapshot& particles,
                          const v1::Background& background) {
    newShadow_ = false;
    if (!plan.runs(Pass::GroundShadow)) return;
    if (!newParticles_ && same(backgroundOf_, background) && shadowIsCurrent_) return;
    shadow_ = castShadow(particles.positions, static_cast<float>(particles.spacing),
                         static_cast<float>(background.floor_height()), sunDirection(background));
    newShadow_ = true;
    shadowIsCurrent_ = true;
  }

  void uploadUniforms(FrameUniforms uniforms) {
    uniforms.shadow[1] = shadow_.corner.x();
    uniforms.shadow[2] = shadow_.corner.y();
    uniforms.shadow[3] = shadow_.edge;
    uniforms_.upload(std::as_bytes(std::span(&uniforms, 1)));
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms_.name());
  }

  /// Everything that is drawn into pixel by pixel starts from nothing.
  void clear(const FramePlan& plan) const {
    constexpr std::array<GLfloat, 4> kNothing{};
    for (const PictureBuffer& buffer : plan.buffers) {
      if (buffer.format != PixelFormat::R32f) continue;
      glClearNamedFramebufferfv(targets_.framebuffer(buffer.resource), GL_COLOR, 0, kNothing.data());
    }
    if (plan.buffer(Resource::Stencil) != nullptr) {
      constexpr GLint kNoLiquid = 0;
      glClearNamedFramebufferiv(targets_.framebuffer(Resource::Surface), GL_STENCIL, 0, &kNoLiquid);
    }
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
      case Pass::Bilateral:
        bilateral_.run(frame);
        break;
      case Pass::CurvatureFlow:
        curvatureFlow_.run(frame);
        break;
      case Pass::ImplicitCurvatureFlow:
        implicitCurvatureFlow_.run(frame);
        break;
      case Pass::Thickness:
        thickness_.runPoints(frame);
        break;
      case Pass::LargeThickness:
        thickness_.runLarge(frame);
        break;
      case Pass::Composite:
        composite_.run(frame);
        break;
      default:
        break;
    }
  }

  core::Frame readBack(const FramePlan& plan, core::ImageSize size) const {
    core::Frame picture;
    picture.size = size;
    picture.pixels.resize(4 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    const Resource source = plan.runs(Pass::Composite) ? Resource::Picture : Resource::Background;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, targets_.framebuffer(source));
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, picture.pixels.data());
    return picture;
  }

  gl::PassClock clock_;
  gl::VertexArray emptyArray_;
  float maxPointPixels_;
  GLint maxEdge_ = 0;

  FrameTargets targets_;
  SplatBuffers splats_;
  gl::StreamBuffer uniforms_;
  core::Plan plan_;

  std::uint64_t uploadedSequence_ = 0;
  bool newParticles_ = false;
  v1::Background backgroundOf_;
  core::Camera cameraOfBackground_;
  ShadowMap shadow_;
  bool shadowIsCurrent_ = false;
  bool newShadow_ = false;

  BackgroundPass background_;
  GroundShadowPass groundShadow_;
  SplatsPass splatsPass_;
  MaskPass mask_;
  BilateralPass bilateral_;
  CurvatureFlowPass curvatureFlow_;
  ImplicitCurvatureFlowPass implicitCurvatureFlow_;
  ThicknessPass thickness_;
  CompositePass composite_;
};

FluidRenderer::FluidRenderer(gl::Context& context) : impl_(std::make_unique<Impl>(context)) {}
FluidRenderer::~FluidRenderer() = default;

core::Frame FluidRenderer::render(const core::ParticleSnapshot& particles, const v1::Look& look,
                                  const v1::Background& background, const core::Camera& camera, core::ImageSize size) {
  return impl_->render(particles, look, background, camera, size);
}

void FluidRenderer::show(View view) { impl_->show(view); }

FloatPicture FluidRenderer::readBuffer(Resource resource) const { return impl_->readBuffer(resource); }

const core::Plan& FluidRenderer::plan() const { return impl_->plan(); }

}  // namespace sluice::render
