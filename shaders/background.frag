// Floor or sky along the line of sight.
#include "frame_uniforms.glsl"
#include "sky.glsl"
#include "floor.glsl"

in vec2 slope;
out vec4 colour;  // linear light; alpha: the share that comes straight from the sun

void main() {
  vec3 direction = toWorldDirection(vec3(slope, 1.0));
#ifdef FLOOR
  float depth = (frame.floorAndHaze.x - frame.eye.y) / direction.y;
  vec2 point = frame.eye.xz + depth * direction.xz;
  // Analytic footprint: moving by one pixel turns the line of sight by C along an axis of view space.
  float step = depth * frame.forwardAndPixel.w;
  vec2 alongX = step * (frame.rightAndSlope.xz - direction.xz * frame.rightAndSlope.y / direction.y);
  vec2 alongY = step * (frame.downAndSlope.xz - direction.xz * frame.downAndSlope.y / direction.y);
  vec2 footprint = max(abs(alongX), abs(alongY));
  float distance = depth * length(direction);
  float far = distance / frame.floorAndHaze.w;
  // The rest of the light on the floor comes from the sky and casts no shadow worth drawing.
  const float sunShare = 0.65;
  colour = vec4(floorRadiance(point, footprint, distance, direction), sunShare * exp(-far * far));
#else
  colour = vec4(skyRadiance(normalize(direction)), 0.0);
#endif
}
