// What a particle is drawn as: an ellipsoid by the flag ELLIPSOID, else a sphere. Either file has a `Shape`, its crossing
// with a line of sight, and the bounds of its outline.

// How a splat lands in its target: pixel slope, width, height, and the margin around the target into which the viewport
// reaches so that points whose centre is outside are drawn, pixels.
layout(location = 0) uniform vec4 target;

// W of the middle of a pixel, in the target's coordinates.
vec2 slopeAt(vec2 pixel) { return (pixel - 0.5 * target.yz) * target.x; }

// Keeps far spheres at least as large as a pixel's centre needs; see visibleRadius in view_splats.h.
float visibleRadius(float radius, float depth) { return max(radius, 0.75 * target.x * depth); }

// Where a line of sight (W, 1) crosses the shape: both depths z solve a·z² − 2m·z + room = 0, z = (m ± √D)/a, where
// D comes without a difference of large squares. As the product of both depths is room/a, the front's inverse depth
// needs no difference either: q = (m + √D)/room.
struct Crossing {
  float a;
  float middle;       // m
  float squaredHalf;  // D; negative where the line of sight misses
  float room;         // negative where the eye is inside
  float unit;         // by how much room is less than the squared distance of the centre, as both are scaled
};

// Of an outline, in view slopes: middle ± halfExtent.
struct Bounds {
  vec2 middle;
  vec2 halfExtent;
};

#ifdef ELLIPSOID
#include "ellipsoid.glsl"
#else
#include "sphere.glsl"
#endif
