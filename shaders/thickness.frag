// Length of the line of sight inside the splat, summed by blending. Overlapping splats hold more than the liquid's
// volume; the factor κ, a particle's volume over its splat's, makes the sum over the picture the liquid's volume again.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "splat_shape.glsl"

flat in Shape shape;
out float thickness;

void main() {
  vec2 W = slopeAt(gl_FragCoord.xy);
  Crossing crossing = crossingAlong(W, shape);
  float root = sqrt(max(crossing.squaredHalf, 0.0));
  // Difference of depths, times a: 2√D, or less where the splat is cut at the near depth.
  float depth = 2.0 * root;
#ifdef LARGE
  float near = crossing.a * liquid.nearDepth.x;
  depth = max(crossing.middle + root - max(crossing.middle - root, near), 0.0);
#endif
  float spacing = liquid.splat.z;
  float perVolume = spacing * spacing * spacing / volumeOf(shape);
  // Δz·√(1+|W|²) is the length along the line of sight.
  thickness = perVolume * depth * length(vec3(W, 1.0)) / crossing.a;
}
