// A straight edge of a pane as a strip that faces the eye, as wide as the edge, and a pixel more on either side.
#include "frame_uniforms.glsl"

layout(location = 0) in vec3 start;
layout(location = 1) in vec3 end;
layout(location = 2) in vec4 glass;
layout(location = 3) in float width;

out vec3 point;
out vec4 tintAndIndex;
out float across;                 // pixels from the middle
flat out float pixels;            // half width
out float gl_ClipDistance[1];

void main() {
  const float nearDepth = 0.01;
  vec3 a = toView(start);
  vec3 b = toView(end);
  // What is behind the eye is cut off, so that the strip keeps its side.
  if (a.z < nearDepth) a = mix(a, b, clamp((nearDepth - a.z) / (b.z - a.z), 0.0, 1.0));
  if (b.z < nearDepth) b = mix(b, a, clamp((nearDepth - b.z) / (a.z - b.z), 0.0, 1.0));
  vec3 P = (gl_VertexID & 1) == 0 ? a : b;
  vec2 along = b.xy / b.z - a.xy / a.z;
  vec2 aside = dot(along, along) > 1e-14 ? normalize(vec2(-along.y, along.x)) : vec2(1.0, 0.0);
  float C = frame.forwardAndPixel.w;
  pixels = 0.5 * width / (max(P.z, nearDepth) * C);
  across = ((gl_VertexID & 2) == 0 ? -1.0 : 1.0) * (pixels + 1.0);
  P.xy += aside * across * C * P.z;
  point = frame.eye.xyz + toWorldDirection(P);
  tintAndIndex = glass;
  gl_Position = vec4(P.xy / vec2(frame.rightAndSlope.w, frame.downAndSlope.w), nearDepth, P.z);
  float above = point.y - frame.floorAndHaze.x;
  gl_ClipDistance[0] = frame.floorAndHaze.z < 0.5 ? 1.0 : frame.eye.y < frame.floorAndHaze.x ? -above : above;
}
