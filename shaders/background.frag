// Floor or sky along the line of sight.
#include "frame_uniforms.glsl"
#include "sky.glsl"
#include "floor.glsl"
#include "tone.glsl"

in vec2 slope;
out vec4 colour;

void main() {
  vec3 direction = toWorldDirection(vec3(slope, 1.0));
#ifdef FLOOR
  float depth = (frame.floorAndHaze.x - frame.eyeAndNear.y) / direction.y;
  vec2 point = frame.eyeAndNear.xz + depth * direction.xz;
  // Analytic footprint: moving by one pixel turns the line of sight by C along an axis of view space.
  float step = depth * frame.forwardAndPixel.w;
  vec2 alongX = step * (frame.rightAndSlope.xz - direction.xz * frame.rightAndSlope.y / direction.y);
  vec2 alongY = step * (frame.downAndSlope.xz - direction.xz * frame.downAndSlope.y / direction.y);
  vec2 footprint = max(abs(alongX), abs(alongY));
  float distance = depth * length(direction);
  vec3 radiance = floorRadiance(point, footprint, distance, direction);
#else
  vec3 radiance = skyRadiance(normalize(direction));
#endif
  colour = vec4(toneMap(radiance), 1.0);
}
