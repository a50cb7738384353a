// A particle's sphere along a line of sight, exactly.

// How a splat lands in its target: pixel slope, width, height, and the margin around the target into which the viewport
// reaches so that points whose centre is outside are drawn, pixels.
layout(location = 0) uniform vec4 target;

// W of the middle of a pixel, in the target's coordinates.
vec2 slopeAt(vec2 pixel) { return (pixel - 0.5 * target.yz) * target.x; }

// Keeps far spheres at least as large as a pixel's centre needs; see visibleRadius in splat_raster.h.
float visibleRadius(float radius, float depth) { return max(radius, 0.75 * target.x * depth); }

// Where the line of sight W crosses the sphere (centre c, radius R). With e = c_xy − c_z·W and k = c_x·W_y − c_y·W_x,
//   z = (m ± √D)/a,  a = 1+|W|²,  m = c·(W, 1),  D = a·R² − |e|² − k²:
// no difference of large squares. As the product of both depths is (|c|²−R²)/a, the front's inverse depth needs no
// difference either: q = (m + √D)/(|c|²−R²). The same terms stand in splat_raster.cpp.
struct Crossing {
  float a;
  float middle;       // m
  float squaredHalf;  // D; negative where the line of sight misses
};

Crossing crossingAlong(vec2 W, vec4 sphere) {
  Crossing crossing;
  crossing.a = 1.0 + dot(W, W);
  vec2 e = sphere.xy - sphere.z * W;
  float k = sphere.x * W.y - sphere.y * W.x;
  crossing.middle = dot(sphere.xy, W) + sphere.z;
  crossing.squaredHalf = crossing.a * sphere.w * sphere.w - dot(e, e) - k * k;
  return crossing;
}
