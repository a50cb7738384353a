// A particle as a point that covers its splat's outline.
#include "frame_uniforms.glsl"
#include "splat_shape.glsl"
#include "splat_attributes.glsl"

flat out Shape shape;

void main() {
  shape = wideEnough(readShape());
  Bounds outline = outlineOf(shape);
  vec2 pixel = outline.middle / target.x + 0.5 * target.yz;
  gl_Position = vec4(2.0 * (pixel + target.w) / (target.yz + 2.0 * target.w) - 1.0, 0.0, 1.0);
  // A tenth of a pixel for the rounding of the rasteriser's grid.
  gl_PointSize = 2.0 * max(outline.halfExtent.x, outline.halfExtent.y) / target.x + 0.1;
}
