// The half of the picture on one side of the horizon: FLOOR, where lines of sight meet the floor, or else the sky.
#include "frame_uniforms.glsl"

out vec2 slope;
out float gl_ClipDistance[1];

void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  slope = (2.0 * corner - 1.0) * vec2(frame.rightAndSlope.w, frame.downAndSlope.w);
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
  // The direction (W, 1) is linear over the picture, so that the horizon is a straight cut.
  float rise = toWorldDirection(vec3(slope, 1.0)).y;
  float towardsFloor = rise * (frame.floorAndHaze.x < frame.eye.y ? -1.0 : 1.0);
#ifdef FLOOR
  gl_ClipDistance[0] = towardsFloor;
#else
  gl_ClipDistance[0] = frame.floorAndHaze.z > 0.5 ? -towardsFloor : 1.0;
#endif
}
