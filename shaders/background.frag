// Floor or surroundings along the line of sight.
#include "frame_uniforms.glsl"
#include "environment.glsl"
#include "floor.glsl"
#include "scene_lights.glsl"
#include "lamps.glsl"
#include "body_shadow.glsl"

in vec2 slope;
out vec4 colour;  // linear light; alpha: the share that comes straight from the sun

#ifndef FLOOR
// The sun itself, for lines of sight alone: mirrors get it as a light's highlight. Twice its 0.53° across, so that it is
// a disc in small pictures too; the radiance is far beyond white, and far below what half floats hold.
vec3 sunDisc(vec3 direction) {
  const float rim = 0.99995;  // cos 0.57°
  float inside = clamp((dot(direction, frame.sun.xyz) - rim) / (0.4 * (1.0 - rim)), 0.0, 1.0);
  return direction.y > 0.0 ? 40.0 * frame.sun.w * inside * frame.sunlight.rgb : vec3(0.0);
}
#endif

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
  float clear = exp(-far * far);
  vec3 radiance = floorRadiance(point, footprint, distance, backgroundRadiance(levelled(direction)));
  float fromSun = frame.floorLight.w * clear;
#ifdef BODIES
  vec3 place = vec3(point.x, frame.floorAndHaze.x, point.y);
  float sunlight = mix(1.0, sunlightPastBodies(place, vec3(0.0, 1.0, 0.0)), lights.sunlight.w);
  float rest = mix(1.0, skyPastBodies(place), clear) * (1.0 - fromSun);
  radiance *= rest + fromSun * sunlight;
  fromSun *= sunlight / max(rest + fromSun * sunlight, 1e-6);
#endif
#ifdef LAMPS
  vec3 above = vec3(0.0, frame.eye.y < frame.floorAndHaze.x ? -1.0 : 1.0, 0.0);
  vec3 lamplight = clear * floorAlbedo(point, footprint) *
                   lampsOn(vec3(point.x, frame.floorAndHaze.x, point.y), above);
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  fromSun *= dot(radiance, luminance) / max(dot(radiance + lamplight, luminance), 1e-6);
  radiance += lamplight;
#endif
  colour = vec4(radiance, fromSun);
#else
  direction = normalize(direction);
  colour = vec4(backgroundRadiance(direction) + sunDisc(direction), 0.0);
#endif
}
