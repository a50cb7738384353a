// Panes of glass, already in the scene's own axes; what is beyond the floor is cut off.
#include "frame_uniforms.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 direction;
layout(location = 2) in vec4 glass;

out vec3 point;
out vec3 normal;
out vec4 tintAndIndex;
out float gl_ClipDistance[1];

void main() {
  point = position;
  normal = direction;
  tintAndIndex = glass;
  vec3 P = toView(point);
  const float nearDepth = 0.01;
  gl_Position = vec4(P.xy / vec2(frame.rightAndSlope.w, frame.downAndSlope.w), nearDepth, P.z);
  float above = point.y - frame.floorAndHaze.x;
  gl_ClipDistance[0] = frame.floorAndHaze.z < 0.5 ? 1.0 : frame.eye.y < frame.floorAndHaze.x ? -above : above;
}
