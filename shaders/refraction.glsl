// Needs frame_uniforms.glsl, liquid_uniforms.glsl and fresnel.glsl. What is seen through clear liquid, and how long the
// way through it was.
layout(binding = 1) uniform sampler2D scene;

// A line of sight where it meets the liquid; all in view space.
struct Entry {
  vec3 place;
  vec3 sight;
  vec3 normal;      // towards the eye
  float cosine;     // of the angle between both
  float slabCosine; // the same before the rim was rounded: thickness goes by the smoothed surface
  float thickness;  // of the liquid along the line of sight, m
  vec2 slope;       // W of the line of sight
  vec3 origin;      // the place in the world
};

struct Transmitted {
  vec3 radiance;  // that comes to the surface from behind, but for what the liquid takes
  float path;     // through liquid, m
};

vec2 placeInPicture(vec2 slope) { return 0.5 + 0.5 * slope / frame.pictureSlopes.xy; }

// The scene at a place in view space. Beyond the picture it is mirrored, which looks like more of the same; a place that
// is not behind `nearest` is not seen through the liquid: there the line of sight goes straight on.
vec3 sceneAt(vec3 hit, float nearest, vec2 straight) {
  vec2 place = placeInPicture(hit.xy / hit.z);
  place = 1.0 - abs(1.0 - abs(place));
  bool behind = hit.z > nearest && all(greaterThanEqual(place, vec2(0.0)));
  return texture(scene, behind ? place : placeInPicture(straight)).rgb;
}

// How far a ray goes until the floor; `far` where it does not meet it.
float untilFloor(float height, float direction, float far) {
  bool meets = frame.floorAndHaze.z > 0.5 && height * direction > 0.0;
  return meets ? min(height / direction, far) : far;
}

const float kFar = 1e3;  // m; as good as endless

#if defined(SCREEN_SHIFT)

// [VDL09] van der Laan et al. 2009, Eqs. (14) and (15): the scene, shifted by β = γT times the normal.
Transmitted transmitted(Entry entry) {
  vec2 perHeight = vec2(frame.pictureSlopes.y / frame.pictureSlopes.x, 1.0);
  vec2 place = placeInPicture(entry.slope) + liquid.scatterAndShift.w * entry.thickness * entry.normal.xy * perHeight;
  return Transmitted(texture(scene, 1.0 - abs(1.0 - abs(place))).rgb, entry.thickness);
}

#elif defined(TWO_INTERFACES)
#include "two_interfaces.glsl"
#else

// Snell's law at the front. Behind, the ray goes on as it came, as behind a slab, until it meets the scene.
Transmitted transmitted(Entry entry) {
  vec3 inside = refract(entry.sight, entry.normal, 1.0 / liquid.absorptionAndIndex.w);
  // A slab that is `thickness` long along the line of sight is that much longer or shorter along the refracted ray.
  float n = liquid.absorptionAndIndex.w;
  float c = entry.slabCosine;
  float path = entry.thickness * c / sqrt(1.0 - (1.0 - c * c) / (n * n) + 1e-6);
  vec3 leaves = entry.place + inside * path;
  float height = frame.floorAndHaze.x - entry.origin.y;
  float fall = toWorldDirection(inside).y;
  // Liquid that stands on the floor: the ray ends there.
  float ends = untilFloor(height, fall, kFar);
  vec3 behind = leaves + entry.sight * untilFloor(height - fall * path, toWorldDirection(entry.sight).y, kFar);
  vec3 hit = ends <= path ? entry.place + inside * ends : behind;
  return Transmitted(sceneAt(hit, entry.place.z, entry.slope), min(path, ends));
}

#endif
