// Needs frame_uniforms.glsl. The light that comes to a place of the liquid from somewhere else than through it.
#include "sky.glsl"
#include "floor.glsl"

// Sky or floor in `direction` from `origin`, as a curved mirror there sees it; both in the world.
vec3 reflectedRadiance(vec3 origin, vec3 direction) {
  float height = frame.floorAndHaze.x - origin.y;
  bool meetsFloor = frame.floorAndHaze.z > 0.5 && height * direction.y > 0.0;
  vec3 sky = skyRadiance(direction);
  if (!meetsFloor) return sky;
  float distance = height / direction.y;
  vec2 point = origin.xz + distance * direction.xz;
  // A curved mirror spreads a pixel: a tenth of the distance stands for its footprint.
  return floorRadiance(point, vec2(0.1 * distance + 0.02), distance, direction);
}

// Radiance of a white surface of that normal that the surroundings alone light: the mean of what they send to it.
vec3 skylight(vec3 normal) {
  // The mean of √y, weighted by y, over the upper half of all directions is 0.8.
  vec3 above = mix(frame.skyHorizon.rgb, frame.skyZenith.rgb, 0.8);
  vec3 below = frame.floorAndHaze.z > 0.5 ? 0.5 * (frame.tileLight.rgb + frame.tileDark.rgb) : 0.55 * frame.skyHorizon.rgb;
  return mix(below, above, 0.5 + 0.5 * normal.y);
}
