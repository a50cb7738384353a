// A drop of spray as a rectangle that covers its sphere's outline.
#include "frame_uniforms.glsl"
#include "splat_shape.glsl"
#include "splat_attributes.glsl"

flat out Shape shape;

void main() {
  shape = wideEnough(readShape());
  Bounds outline = outlineOf(shape);
  vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
  vec2 place = outline.middle + corner * (outline.halfExtent + target.x);
  gl_Position = vec4(place / vec2(frame.rightAndSlope.w, frame.downAndSlope.w), 0.0, 1.0);
}
