// Inverse depth of the sphere's front. Blended with MAX, so that the nearest sphere stays; a miss adds nothing.
#include "frame_uniforms.glsl"
#include "sphere.glsl"

flat in vec4 sphere;
out float inverseDepth;

void main() {
  Crossing crossing = crossingAlong(slopeAt(gl_FragCoord.xy), sphere);
  float root = sqrt(max(crossing.squaredHalf, 0.0));
  bool hit = crossing.squaredHalf >= 0.0;
#ifdef LARGE
  // A sphere that reaches before the near depth is cut off there; one that ends before it is not seen. The eye may be
  // inside, where the product of both depths is negative: 1/z of the entry is a/(m − √D).
  float nearest = 1.0 / frame.eyeAndNear.w;
  float entry = crossing.middle - root > 0.0 ? min(crossing.a / (crossing.middle - root), nearest) : nearest;
  hit = hit && crossing.middle + root > crossing.a * frame.eyeAndNear.w;
#else
  float entry = (crossing.middle + root) / (dot(sphere.xyz, sphere.xyz) - sphere.w * sphere.w);
#endif
  // Flat rims: see kRimDepth in frame_plan.h.
  float rim = frame.splat.w > 0.0 ? 1.0 / (sphere.z - frame.splat.w * sphere.w) : 0.0;
#ifdef LARGE
  rim = sphere.z - frame.splat.w * sphere.w > frame.eyeAndNear.w ? rim : 0.0;
#endif
  inverseDepth = hit ? max(entry, rim) : 0.0;
}
