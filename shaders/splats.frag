// Inverse depth of the splat's front. Blended with MAX, so that the nearest stays; a miss adds nothing.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "splat_shape.glsl"

flat in Shape shape;
out float inverseDepth;

void main() {
#ifdef DISC
  // At the centre's depth, parallel to the picture.
  vec2 e = shape.sphere.xy - shape.sphere.z * slopeAt(gl_FragCoord.xy);
  bool hit = dot(e, e) <= shape.sphere.w * shape.sphere.w && shape.sphere.z >= liquid.nearDepth.x;
  float entry = 1.0 / shape.sphere.z;
#else
  Crossing crossing = crossingAlong(slopeAt(gl_FragCoord.xy), shape);
  float root = sqrt(max(crossing.squaredHalf, 0.0));
  bool hit = crossing.squaredHalf >= 0.0;
#ifdef LARGE
  // What reaches before the near depth is cut off there; what ends before it is not seen. The eye may be inside, where
  // the product of both depths is negative: 1/z of the entry is a/(m − √D).
  float nearest = 1.0 / liquid.nearDepth.x;
  float entry = crossing.middle - root > 0.0 ? min(crossing.a / (crossing.middle - root), nearest) : nearest;
  hit = hit && crossing.middle + root > crossing.a * liquid.nearDepth.x;
#else
  float entry = (crossing.middle + root) / crossing.room;
#endif
  // Flat rims, see rimOf in splat_rows.h; none where the eye is inside.
  if (liquid.splat.w > 0.0 && crossing.room > 0.0) {
    float squared = crossing.room + crossing.unit;
    float rim = crossing.middle / (squared - liquid.splat.w * sqrt(squared * crossing.unit));
#ifdef LARGE
    rim = min(rim, nearest);
#endif
    entry = max(entry, rim);
  }
#endif
  inverseDepth = hit ? entry : 0.0;
}
