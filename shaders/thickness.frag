// Length of the line of sight inside the sphere, summed by blending. Overlapping spheres hold more than the liquid's
// volume; the factor κ = V/(4/3·πR³) makes the sum over the picture the liquid's volume again.
#include "frame_uniforms.glsl"
#include "sphere.glsl"

flat in vec4 sphere;
out float thickness;

void main() {
  Crossing crossing = crossingAlong(slopeAt(gl_FragCoord.xy), sphere);
  float root = sqrt(max(crossing.squaredHalf, 0.0));
  // Difference of depths, times a: 2√D, or less where the sphere is cut at the near depth.
  float depth = 2.0 * root;
#ifdef LARGE
  float near = crossing.a * frame.eyeAndNear.w;
  depth = max(crossing.middle + root - max(crossing.middle - root, near), 0.0);
#endif
  // A sphere of another radius than the usual one still holds the same volume.
  float widened = frame.splat.x / sphere.w;
  // (Δz)·√a is the length along the line of sight.
  thickness = frame.splat.y * widened * widened * widened * depth * inversesqrt(crossing.a);
}
