#include "passes.h"
#include "same.h"

namespace sluice::render {

namespace {

std::string_view flagOf(const v1::Tone& tone) {
  switch (tone.operator_case()) {
    case v1::Tone::kFilmic:
      return "FILMIC";
    case v1::Tone::kReinhard:
      return "REINHARD";
    case v1::Tone::kClip:
      return "CLIP";
    default:
      return "SOFT_CLIP";
  }
}

}  // namespace

std::vector<std::uint8_t> ToneMapPass::run(const FrameContext& frame) {
  const Resource from = frame.targets.has(Resource::Picture) ? Resource::Picture : Resource::Background;
  const core::ImageSize size = frame.targets.size(from);
  std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  const v1::Tone& tone = frame.scene.tone();
  if (frame.plan.device.software) {
    // Half floats come as they are; the table then does better and faster than a pass and the driver's conversion.
    if (!table_ || !same(toneOf_, tone)) {
      table_.emplace(tone);
      toneOf_ = tone;
    }
    radiance_.resize(pixels.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame.targets.framebuffer(from));
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_HALF_FLOAT, radiance_.data());
    table_->apply(radiance_, pixels);
    return pixels;
  }
  const std::string_view flag = flagOf(tone);
  auto program = programs_.find(flag);
  if (program == programs_.end()) {
    program = programs_.emplace(flag, shaders().program("picture.vert", "tone_map.frag", std::array{flag})).first;
  }
  beginTarget(frame, Resource::Screen);
  bindTexture(frame, 0, from);
  glUseProgram(program->second.name());
  glProgramUniform1f(program->second.name(), 0, std::exp2(static_cast<float>(tone.exposure())));
  drawPicture();
  glBindFramebuffer(GL_READ_FRAMEBUFFER, frame.targets.framebuffer(Resource::Screen));
  glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  return pixels;
}

}  // namespace sluice::render
