// Length of the line of sight inside the sphere, summed by blending. Overlapping spheres hold more than the liquid's
// volume; the factor κ = V/(4/3·πR³) makes the sum over the picture the liquid's volume again.
#include "frame_uniforms.glsl"
#include "sphere.glsl"

flat in vec4 sphere;
out float thickness;

void main() {
  vec2 W = slopeAt(gl_FragCoord.xy);
  Chord chord = chordAlong(W, sphere);
  float nearDepth = frame.eyeAndNear.w;
  float length = max(chord.exit - max(chord.entry, nearDepth), 0.0) * sqrt(1.0 + dot(W, W));
  // A sphere widened to a pixel's size still holds its own volume.
  float widened = frame.splat.x / sphere.w;
  thickness = chord.squaredHalf >= 0.0 ? frame.splat.y * widened * widened * widened * length : 0.0;
}
