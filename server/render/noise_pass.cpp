#include <cmath>

#include "passes.h"

namespace sluice::render {

namespace {

bool withViolence(const FrameContext& frame) { return frame.plan.buffer(Resource::Violence, frame.liquid) != nullptr; }

void finish(const FrameContext& frame, Resource into, const gl::Program& program) {
  beginTarget(frame, into);
  bindTexture(frame, 0, Resource::NoiseSums);
  glUseProgram(program.name());
  drawPicture();
}

}  // namespace

void NoisePass::run(const FrameContext& frame) {
  const v1::Noise& noise = frame.look.noise();
  const std::vector<NoiseSprite> sprites = makeNoiseSprites(frame.particles, frame.selection, frame.violence, noise,
                                                            frame.surfaceView, frame.scale.nearDepth);
  const auto fallOff = static_cast<float>(noise.depth_in_spacings()) * frame.scale.spacing;
  if (!frame.plan.device.software) {
    drawOnDevice(frame, sprites, fallOff);
    return;
  }
  const std::span<float> violence =
      withViolence(frame) ? frame.targets.startAnew(Resource::Violence) : std::span<float>{};
  raster_.draw(sprites, frame.surfaceView, fallOff, frame.targets.read(Resource::Surface),
               frame.targets.startAnew(Resource::Noise), violence);
}

void NoisePass::drawOnDevice(const FrameContext& frame, std::span<const NoiseSprite> sprites, float fallOff) {
  if (!onDevice_) onDevice_.emplace();
  onDevice_->upload(sprites);
  frame.targets.clear(Resource::NoiseSums);
  beginTarget(frame, Resource::NoiseSums);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
  bindTexture(frame, 0, Resource::Surface);
  glProgramUniform1f(onDevice_->sum().name(), 0, 1.0F / fallOff);
  glUseProgram(onDevice_->sum().name());
  onDevice_->drawSprites();

  const gl::VertexArray nothing = gl::makeVertexArray();
  glBindVertexArray(nothing.name());
  finish(frame, Resource::Noise, onDevice_->finishNoise());
  if (withViolence(frame)) finish(frame, Resource::Violence, onDevice_->finishViolence());
}

void bindNoise(const FrameContext& frame, const gl::Program& program) {
  constexpr GLuint kNoise = 16;
  constexpr GLuint kViolence = 17;
  constexpr GLint kStrength = 40;
  bindTexture(frame, kNoise, Resource::Noise);
  if (withViolence(frame)) bindTexture(frame, kViolence, Resource::Violence);
  const v1::Noise& noise = frame.look.noise();
  glProgramUniform3f(program.name(), kStrength, static_cast<float>(noise.whitening()),
                     static_cast<float>(noise.still_share()), 1.0F / typicalNoise(noise, frame.scale.spacing));
}

}  // namespace sluice::render
