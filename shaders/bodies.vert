// A body's triangles, in the picture or, with SHADOW, as the sun sees them. What is beyond the floor is cut off, so that
// the floor itself needs no depth.
#include "frame_uniforms.glsl"
#include "scene_lights.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 direction;

layout(location = 0) uniform mat4 pose;

out vec3 point;
out vec3 normal;
out float gl_ClipDistance[1];

// Depths are stored as q times this, 0 at infinity: as floats, even in all distances.
const float nearDepth = 0.01;

void main() {
  point = (pose * vec4(position, 1.0)).xyz;
  normal = mat3(pose) * direction;
#ifdef SHADOW
  vec4 at = vec4(point, 1.0);
  gl_Position = vec4(2.0 * dot(lights.toShadowU, at) - 1.0, 2.0 * dot(lights.toShadowV, at) - 1.0,
                     dot(lights.toShadowDepth, at), 1.0);
  gl_ClipDistance[0] = 1.0;
#else
  vec3 P = toView(point);
  gl_Position = vec4(P.xy / vec2(frame.rightAndSlope.w, frame.downAndSlope.w), nearDepth, P.z);
  float above = point.y - frame.floorAndHaze.x;
  gl_ClipDistance[0] = frame.floorAndHaze.z < 0.5 ? 1.0 : frame.eye.y < frame.floorAndHaze.x ? -above : above;
#endif
}
