// A particle's sphere along a line of sight, exactly.

// How a splat lands in its target: pixel slope, width, height, and the margin around the target into which the viewport
// reaches so that points whose centre is outside are drawn, pixels.
layout(location = 0) uniform vec4 target;

// W of the middle of a pixel, in the target's coordinates.
vec2 slopeAt(vec2 pixel) { return (pixel - 0.5 * target.yz) * target.x; }

// Keeps far spheres at least as large as a pixel's centre needs; see visibleRadius in splat_selection.h.
float visibleRadius(float depth) { return max(frame.splat.x, 0.75 * target.x * depth); }

// Chord of the sphere (centre, radius) along W. Writing the centre as c = c_z·(W, 1) + (e, 0) gives the depths
// z = c_z + (e·W ± √D)/a with a = 1+|W|² and D = a·R² − (a|e|² − (e·W)²): no difference of large squares.
struct Chord {
  float squaredHalf;  // D; negative where the line of sight misses
  float entry;        // eye depths, m
  float exit;
};

Chord chordAlong(vec2 W, vec4 sphere) {
  float a = 1.0 + dot(W, W);
  vec2 e = sphere.xy - sphere.z * W;
  float along = dot(e, W);
  Chord chord;
  chord.squaredHalf = a * sphere.w * sphere.w - (a * dot(e, e) - along * along);
  float root = sqrt(max(chord.squaredHalf, 0.0));
  chord.entry = sphere.z + (along - root) / a;
  chord.exit = sphere.z + (along + root) / a;
  return chord;
}
