// A particle as a rectangle that covers its splat's outline: for splats larger than a point may be, or that reach nearer
// than the near depth, whose outline may fill any part of the picture.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "splat_shape.glsl"
#include "splat_attributes.glsl"

flat out Shape shape;

void main() {
  shape = wideEnough(readShape());
  vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
  vec2 place = corner;
  if (frontDepth(shape) >= liquid.nearDepth.x) {
    Bounds outline = outlineOf(shape);
    place = (outline.middle + corner * (outline.halfExtent + target.x)) /
            vec2(frame.rightAndSlope.w, frame.downAndSlope.w);
  }
  gl_Position = vec4(place, 0.0, 1.0);
}
