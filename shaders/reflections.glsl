// Needs frame_uniforms.glsl. The light that comes to a place of the liquid from somewhere else than through it.
#include "environment.glsl"
#include "floor.glsl"
#ifdef BODY_MIRROR
#include "body_mirror.glsl"
#endif

// How far it is to the floor in `direction` from `origin`, m; below 0 where it is not there.
float distanceToFloor(vec3 origin, vec3 direction) {
  float height = frame.floorAndHaze.x - origin.y;
  return frame.floorAndHaze.z > 0.5 && height * direction.y > 0.0 ? height / direction.y : -1.0;
}

// Surroundings or floor in `direction` from `origin`, both in the world. One look at the surroundings serves both: where
// there is floor, at its horizon. `footprint` is a pixel's box on the floor.
vec3 surroundingsSeen(vec3 origin, vec3 direction, vec2 footprint, bool asBackground) {
  float distance = distanceToFloor(origin, direction);
  vec3 around = distance > 0.0 ? levelled(direction) : direction;
  vec3 radiance = asBackground ? backgroundRadiance(around) : environmentRadiance(around);
  return distance > 0.0 ? floorRadiance(origin.xz + distance * direction.xz, footprint, distance, radiance) : radiance;
}

// What a mirror shows, with the bodies,
vec3 reflectedRadiance(vec3 origin, vec3 direction) {
  // A curved mirror spreads a pixel: over as much floor as lies between its neighbours' places there.
  vec2 point = origin.xz + max(distanceToFloor(origin, direction), 0.0) * direction.xz;
  vec2 footprint = fwidth(point);
#ifdef BODY_MIRROR
  vec4 body = bodySeen(origin, direction);
  if (body.a > 0.0) return body.rgb;
#endif
  return surroundingsSeen(origin, direction, footprint, false);
}
// and what is seen through the liquid, a backdrop too.
vec3 transmittedRadiance(vec3 origin, vec3 direction) {
  // A tenth of the distance stands for the footprint of what a curved surface has bent.
  vec2 footprint = vec2(0.1 * max(distanceToFloor(origin, direction), 0.0) + 0.02);
  return surroundingsSeen(origin, direction, footprint, true);
}

// Radiance of a white surface of that normal that the surroundings alone light; the floor stands for their lower half.
vec3 skylight(vec3 normal) {
  if (frame.floorAndHaze.z < 0.5) return ambientLight(normal);
  vec3 floorLight = 0.5 * (frame.tileLight.rgb + frame.tileDark.rgb) * frame.floorLight.rgb;
  return mix(floorLight, ambientAbove(), 0.5 + 0.5 * normal.y);
}
