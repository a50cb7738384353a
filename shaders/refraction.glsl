// Needs frame_uniforms.glsl, liquid_uniforms.glsl,
// picture_place.glsl, scene_depth.glsl and fresnel.glsl. What is seen through clear liquid, and how long the
// way through it was.

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

// Whether the scene in this direction is behind depth z: no body stands before that.
bool isBehind(float z, vec2 slope) {
#ifdef BODIES
  vec2 at = 0.5 + 0.5 * slope / frame.pictureSlopes.xy;
  vec4 q = textureGather(sceneDepth, at);  // of every pixel that shows in a sample there
  // Pixels that a body covers in part show it, and have no depth of it: a pixel farther in has.
  vec2 beside = 1.5 / vec2(textureSize(sceneDepth, 0));
  q = max(q, vec4(texture(sceneDepth, at + beside).r, texture(sceneDepth, at - beside).r,
                  texture(sceneDepth, at + vec2(beside.x, -beside.y)).r,
                  texture(sceneDepth, at + vec2(-beside.x, beside.y)).r));
  float nearest = max(max(q.x, q.y), max(q.z, q.w));
  // Of all these places, the floor is nearest in one of the corners: its inverse depth is linear over the picture.
  vec2 step = 4.0 / vec2(textureSize(sceneDepth, 0)) * frame.pictureSlopes.xy;
  float rise = abs(toWorldDirection(vec3(step.x, 0.0, 0.0)).y) + abs(toWorldDirection(vec3(0.0, step.y, 0.0)).y);
  float floorNear = 1.02 * floorInverseDepth(slope) + rise / abs(frame.floorAndHaze.x - frame.eye.y);
  return nearest * z < 1.0 || nearest < floorNear;
#else
  return true;
#endif
}

// Where a ray that starts at `place` in view space, and would go on for `far`, meets a body; both m. What stands before
// the start is not met.
float untilBody(vec3 place, vec3 direction, float far) {
#ifdef BODIES
  for (int i = 0; i < 2; ++i) {
    vec3 end = place + far * direction;
    float q = end.z > 0.0 ? bodyDepthAt(end.xy / end.z) : 0.0;
    if (q * place.z >= 1.0 || q * end.z <= 1.0) break;
    far = (1.0 / q - place.z) / direction.z;
  }
#endif
  return far;
}

// The scene in a direction that a ray came to behind depth `nearest`. Beyond the picture it is mirrored, which looks
// like more of the same; what is not behind the liquid is not seen through it: there the line of sight goes straight on.
vec3 sceneTowards(vec2 slope, bool ahead, float nearest, vec2 straight) {
#ifdef PLAIN_BEHIND
  return backgroundRadiance(vec3(0.0, 1.0, 0.0));
#else
  vec2 place = placeInPicture(slope);
  place = 1.0 - abs(1.0 - abs(place));
  bool behind = ahead && all(greaterThanEqual(place, vec2(0.0))) && isBehind(nearest, slope);
  return texture(scene, behind ? place : placeInPicture(straight)).rgb;
#endif
}

// How far a ray goes until the floor; `far` where it does not meet it.
float untilFloor(float height, float direction, float far) {
  bool meets = frame.floorAndHaze.z > 0.5 && height * direction > 0.0;
  return meets ? min(height / direction, far) : far;
}

const float kFar = 1e3;  // m; as good as endless

#if defined(SCREEN_SHIFT)

// [VDL09] van der Laan et al. 2009, Eqs. (14) and (15): the scene, shifted by β = γT times the normal, in heights of the
// picture.
Transmitted transmitted(Entry entry) {
  vec2 shift = 2.0 * frame.pictureSlopes.y * liquid.scatterAndShift.w * entry.thickness * entry.normal.xy;
  return Transmitted(sceneTowards(entry.slope + shift, true, entry.place.z, entry.slope), entry.thickness);
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
  // The ray may end inside, where liquid stands on the floor, or around a body.
  float ends = untilBody(entry.place, inside, untilFloor(height, fall, path));
  float beyond = untilFloor(height - fall * path, toWorldDirection(entry.sight).y, kFar);
  vec3 hit = ends < path ? entry.place + inside * ends : leaves + entry.sight * untilBody(leaves, entry.sight, beyond);
  return Transmitted(sceneTowards(hit.xy / hit.z, hit.z > entry.place.z, entry.place.z, entry.slope), ends);
}

#endif
