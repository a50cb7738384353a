// A particle's sphere along a line of sight, exactly.

// How a splat lands in its target: pixel slope, width, height, and the margin around the target into which the viewport
// reaches so that points whose centre is outside are drawn, pixels.
layout(location = 0) uniform vec4 target;

// W of the middle of a pixel, in the target's coordinates.
vec2 slopeAt(vec2 pixel) { return (pixel - 0.5 * target.yz) * target.x; }

// Keeps far spheres at least as large as a pixel's centre needs; see visibleRadius in splat_selection.h.
float visibleRadius(float depth) { return max(frame.splat.x, 0.75 * target.x * depth); }

// Where the line of sight W crosses the sphere (centre, radius). Writing the centre as c = c_z·(W, 1) + (e, 0) gives the
// depths z = (m ± √D)/a with a = 1+|W|², m = a·c_z + e·W and D = a·R² − (a|e|² − (e·W)²): no difference of large squares.
struct Crossing {
  float a;
  float middle;       // m
  float squaredHalf;  // D; negative where the line of sight misses
};

Crossing crossingAlong(vec2 W, vec4 sphere) {
  Crossing crossing;
  crossing.a = 1.0 + dot(W, W);
  vec2 e = sphere.xy - sphere.z * W;
  float along = dot(e, W);
  crossing.middle = crossing.a * sphere.z + along;
  crossing.squaredHalf = crossing.a * sphere.w * sphere.w - (crossing.a * dot(e, e) - along * along);
  return crossing;
}
