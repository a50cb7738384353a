// One triangle that covers the picture.
#include "frame_uniforms.glsl"

out vec2 uv;
out vec2 slope;  // W = (x/z, y/z) of the line of sight

void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  uv = corner;
  slope = (2.0 * corner - 1.0) * vec2(frame.rightAndSlope.w, frame.downAndSlope.w);
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
