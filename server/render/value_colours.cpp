#include "value_colours.h"

#include <algorithm>
#include <array>

#include "passes.h"
#include "same.h"
#include "tone_curve.h"

namespace sluice::render {

float radianceShownAs(float linear, const v1::Tone& tone) {
  // Every operator rises: halving the interval 40 times leaves less than a float's resolution.
  constexpr float kBrightest = 64.0F;
  float low = 0.0F;
  float high = kBrightest;
  for (int i = 0; i < 40; ++i) {
    const float middle = 0.5F * (low + high);
    (toneMapped(middle, tone) < linear ? low : high) = middle;
  }
  return high;
}

void ColourTable::usePalette(v1::ColourMap::PaletteCase palette, const v1::Tone& tone) {
  std::vector<Eigen::Vector3f> linear(kPaletteColours);
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(linear.size() - 1);
    linear[i] = paletteColour(palette, share).unaryExpr(&linearOfSrgb);
  }
  upload(linear, tone);
}

void ColourTable::useColour(const Eigen::Vector3f& linear, const v1::Tone& tone) { upload(std::array{linear}, tone); }

void ColourTable::upload(std::span<const Eigen::Vector3f> linear, const v1::Tone& tone) {
  if (std::ranges::equal(colours_, linear) && same(toneOf_, tone)) return;
  colours_.assign(linear.begin(), linear.end());
  toneOf_ = tone;
  std::vector<float> radiances;
  for (const Eigen::Vector3f& colour : linear) {
    for (const float component : {colour.x(), colour.y(), colour.z()}) {
      radiances.push_back(radianceShownAs(component, tone));
    }
    radiances.push_back(1.0F);
  }
  const core::ImageSize size{static_cast<int>(linear.size()), 1};
  texture_ = gl::makeTexture(GL_RGBA16F, size);
  glTextureSubImage2D(texture_.name(), 0, 0, 0, size.width, size.height, GL_RGBA, GL_FLOAT, radiances.data());
  gl::setBilinear(texture_);
}

void beginOverPicture(const FrameContext& frame, const gl::Program& program) {
  beginTarget(frame, Resource::Picture);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame.surfaceUniforms);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bindTexture(frame, 0, Resource::Surface);
  if (frame.plan.layers > 1) bindOtherSurfaces(frame, program);
  glUseProgram(program.name());
}

void setRange(const gl::Program& program, const ValueRange& range, float strength, const ViewGeometry& values) {
  glProgramUniform3f(program.name(), 0, range.least, 1.0F / range.width(), strength);
  glProgramUniform2f(program.name(), 1, values.maxSlope.x(), values.maxSlope.y());
}

}  // namespace sluice::render
