// The part of the floor that the shadow map covers, as a square in the scene.
#include "frame_uniforms.glsl"

out vec3 view;
out vec2 mapPosition;

void main() {
  mapPosition = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 point = frame.shadow.yz + frame.shadow.w * mapPosition;
  view = toView(vec3(point.x, frame.floorAndHaze.x, point.y));
  // Depth 0 everywhere: what lies behind the eye is still clipped, by w.
  gl_Position = vec4(view.xy / vec2(frame.rightAndSlope.w, frame.downAndSlope.w), 0.0, view.z);
}
