// Inverse depth of the sphere's front. Blended with MAX, so that the nearest sphere stays; a miss adds nothing.
#include "frame_uniforms.glsl"
#include "sphere.glsl"

flat in vec4 sphere;
out float inverseDepth;

void main() {
  Chord chord = chordAlong(slopeAt(gl_FragCoord.xy), sphere);
  float nearDepth = frame.eyeAndNear.w;
  bool hit = chord.squaredHalf >= 0.0 && chord.exit > nearDepth;
  inverseDepth = hit ? 1.0 / max(chord.entry, nearDepth) : 0.0;
}
