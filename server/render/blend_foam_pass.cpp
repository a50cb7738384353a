#include <Eigen/Geometry>

#include "foam_dots.h"
#include "liquid_uniforms.h"
#include "pack.h"
#include "passes.h"

namespace sluice::render {

namespace {

/// Draws into no more of the picture than the dots cover.
void keepToFoam(const FrameContext& frame) {
  Eigen::AlignedBox2f bounds;
  for (const FoamDot& dot : frame.foam) {
    const Eigen::Vector2f middle = frame.view.toPixel(Eigen::Vector2f(dot.x, dot.y) / dot.z);
    // A dot below a pixel is drawn a little larger than that.
    const Eigen::Vector2f reach = Eigen::Vector2f::Constant(dot.radius / (dot.z * frame.view.pixelSlope) + 2);
    bounds.extend(Eigen::AlignedBox2f(middle - reach, middle + reach));
  }
  const Eigen::Array2i low = bounds.min().array().max(0).cast<int>();
  const Eigen::Array2i high = bounds.max().array().ceil().cast<int>();
  glEnable(GL_SCISSOR_TEST);
  glScissor(low.x(), low.y(), high.x() - low.x(), high.y() - low.y());
}

}  // namespace

BlendFoamPass::BlendFoamPass() : program_(shaders().program("picture.vert", "blend_foam.frag")) {}

void BlendFoamPass::run(const FrameContext& frame) const {
  beginTarget(frame, Resource::Picture);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // Colours come multiplied by their coverage.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bindTexture(frame, 0, Resource::Foam);
  // Foam is made by liquids together, and looks like the first.
  const v1::Liquid& liquid = frame.scene.look().liquid();
  const v1::Vec3& white = frame.scene.foam().colour();
  const Eigen::Array3f colour =
      sprayTint(liquid, frame.particles.spacing) * Eigen::Array3d(white.x(), white.y(), white.z()).cast<float>();
  glProgramUniform3fv(program_.name(), 0, 1, colour.data());
  const auto glow = glows(liquid) ? pack(liquid.emission()) : std::array<float, 4>{};
  glProgramUniform3fv(program_.name(), 1, 1, glow.data());
  glUseProgram(program_.name());
  keepToFoam(frame);
  drawPicture();
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace sluice::render
