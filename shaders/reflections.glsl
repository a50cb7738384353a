// Needs frame_uniforms.glsl. The light that comes to a place of the liquid from somewhere else than through it.
#include "environment.glsl"
#include "floor.glsl"
#ifdef BODY_MIRROR
#include "body_mirror.glsl"
#endif

// Surroundings or floor in `direction` from `origin`, as a curved mirror there sees it; both in the world. One look at
// the surroundings serves both: where there is floor, at its horizon.
vec3 surroundingsSeen(vec3 origin, vec3 direction, bool asBackground) {
  float height = frame.floorAndHaze.x - origin.y;
  bool meetsFloor = frame.floorAndHaze.z > 0.5 && height * direction.y > 0.0;
  vec3 around = meetsFloor ? levelled(direction) : direction;
  vec3 radiance = asBackground ? backgroundRadiance(around) : environmentRadiance(around);
  if (!meetsFloor) return radiance;
  float distance = height / direction.y;
  vec2 point = origin.xz + distance * direction.xz;
  // A curved mirror spreads a pixel: a tenth of the distance stands for its footprint.
  return floorRadiance(point, vec2(0.1 * distance + 0.02), distance, radiance);
}

// What a mirror shows, with the bodies,
vec3 reflectedRadiance(vec3 origin, vec3 direction) {
#ifdef BODY_MIRROR
  vec4 body = bodySeen(origin, direction);
  if (body.a > 0.0) return body.rgb;
#endif
  return surroundingsSeen(origin, direction, false);
}
// and what is seen through the liquid, a backdrop too.
vec3 transmittedRadiance(vec3 origin, vec3 direction) { return surroundingsSeen(origin, direction, true); }

// Radiance of a white surface of that normal that the surroundings alone light; the floor stands for their lower half.
vec3 skylight(vec3 normal) {
  if (frame.floorAndHaze.z < 0.5) return ambientLight(normal);
  vec3 floorLight = 0.5 * (frame.tileLight.rgb + frame.tileDark.rgb) * frame.floorLight.rgb;
  return mix(floorLight, ambientAbove(), 0.5 + 0.5 * normal.y);
}
