#pragma once

#include <span>

#include <Eigen/Core>

#include "frame_context.h"
#include "palette.h"
#include "particle_values.h"

namespace sluice::render {

/// Radiance at which the scene's tone map shows a component as bright as `linear`, 0 to 1: a colour that has to be true
/// to a legend is drawn with it. Of what no radiance reaches, the brightest that a half float holds well.
float radianceShownAs(float linear, const v1::Tone& tone);

/// Colours for a shader to look up, as radiances that the scene's tone map shows as they are.
class ColourTable {
 public:
  /// Makes it anew only where palette or tone have changed.
  void usePalette(v1::ColourMap::PaletteCase palette, const v1::Tone& tone);
  /// The one colour, linear.
  void useColour(const Eigen::Vector3f& linear, const v1::Tone& tone);

  void bind(GLuint binding) const { glBindTextureUnit(binding, texture_.name()); }

 private:
  void upload(std::span<const Eigen::Vector3f> linear, const v1::Tone& tone);

  gl::Texture texture_;
  std::vector<Eigen::Vector3f> colours_;
  v1::Tone toneOf_;
};

/// Begins to draw over the picture with the uniforms of the surface at hand, its inverse depths at binding 0, and, of
/// several liquids, the others; colours come multiplied by their coverage.
void beginOverPicture(const FrameContext& frame, const gl::Program& program);

/// The uniforms `range` and `valueSlopes` of such a shader.
void setRange(const gl::Program& program, const ValueRange& range, float strength, const ViewGeometry& values);

}  // namespace sluice::render
