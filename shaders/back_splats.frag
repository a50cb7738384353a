// Depth at which the line of sight leaves the splat, m. Blended with MAX, so that the farthest stays; a miss adds nothing.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "splat_shape.glsl"

flat in Shape shape;
out float depth;

void main() {
#ifdef DISC
  vec2 e = shape.sphere.xy - shape.sphere.z * slopeAt(gl_FragCoord.xy);
  bool hit = dot(e, e) <= shape.sphere.w * shape.sphere.w && shape.sphere.z >= liquid.nearDepth.x;
  depth = hit ? shape.sphere.z : 0.0;
#else
  Crossing crossing = crossingAlong(slopeAt(gl_FragCoord.xy), shape);
  float far = (crossing.middle + sqrt(max(crossing.squaredHalf, 0.0))) / crossing.a;
  // Flat rims, see backRimOf in splat_rows.h; none where the eye is inside.
  if (liquid.splat.w > 0.0 && crossing.room > 0.0) {
    float squared = crossing.room + crossing.unit;
    far = max(far, (squared + liquid.splat.w * sqrt(squared * crossing.unit)) / crossing.middle);
  }
  depth = crossing.squaredHalf >= 0.0 && far > liquid.nearDepth.x ? far : 0.0;
#endif
}
