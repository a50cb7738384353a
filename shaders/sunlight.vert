// The part of the floor that the light map covers, as a parallelogram in the scene.
#include "frame_uniforms.glsl"

out vec2 mapPosition;

void main() {
  mapPosition = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec3 view = toView(frame.lightCorner.xyz + mapPosition.x * frame.lightRight.xyz + mapPosition.y * frame.lightDown.xyz);
  // Depth 0 everywhere: what lies behind the eye is still clipped, by w.
  gl_Position = vec4(view.xy / vec2(frame.rightAndSlope.w, frame.downAndSlope.w), 0.0, view.z);
}
