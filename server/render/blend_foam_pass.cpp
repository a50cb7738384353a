#include <algorithm>
#include <vector>

#include "foam_dots.h"
#include "liquid_uniforms.h"
#include "pack.h"
#include "passes.h"

namespace sluice::render {

namespace {

/// Rows of the picture that are drawn at a time.
constexpr int kStripRows = 32;

/// Of every strip of rows, the columns that dots cover: foam is in few places of most pictures.
std::vector<PixelRect> placesOf(std::span<const FoamDot> dots, const ViewGeometry& view) {
  const int width = view.size.width;
  const int height = view.size.height;
  struct Columns {
    int first, last;
  };
  std::vector<Columns> strips(static_cast<std::size_t>((height + kStripRows - 1) / kStripRows), {width, -1});
  for (const FoamDot& dot : dots) {
    const Eigen::Vector2f middle = view.toPixel(Eigen::Vector2f(dot.x, dot.y) / dot.z);
    // A dot below a pixel is drawn a little larger than that.
    const float reach = dot.radius / (dot.z * view.pixelSlope) + 2;
    const int top = std::clamp(static_cast<int>(middle.y() - reach), 0, height - 1) / kStripRows;
    const int bottom = std::clamp(static_cast<int>(middle.y() + reach), 0, height - 1) / kStripRows;
    for (int strip = top; strip <= bottom; ++strip) {
      Columns& columns = strips[static_cast<std::size_t>(strip)];
      columns.first = std::min(columns.first, std::max(static_cast<int>(middle.x() - reach), 0));
      columns.last = std::max(columns.last, std::min(static_cast<int>(middle.x() + reach) + 1, width - 1));
    }
  }
  std::vector<PixelRect> places;
  for (int strip = 0; strip < static_cast<int>(strips.size()); ++strip) {
    const auto [first, last] = strips[static_cast<std::size_t>(strip)];
    const int top = strip * kStripRows;
    if (last >= first) places.push_back({first, top, last - first + 1, std::min(kStripRows, height - top)});
  }
  return places;
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
  drawPicture(placesOf(frame.foam, frame.view));
}

}  // namespace sluice::render
