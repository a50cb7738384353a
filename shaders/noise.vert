// The noise around a particle as a square about its disc, parallel to the picture. See NoiseSprite.
#include "frame_uniforms.glsl"

layout(location = 0) in vec4 centreAndRadius;   // in view space, m
layout(location = 1) in vec4 turnAndOrigin;     // onto the lattice, cells
layout(location = 2) in uint latticeSeed;
layout(location = 3) in vec2 heightAndViolence; // m; 0 to 1

flat out vec4 disc;
flat out vec4 toLattice;
flat out uint seed;
flat out float height;
flat out float violence;

void main() {
  disc = centreAndRadius;
  toLattice = turnAndOrigin;
  seed = latticeSeed;
  height = heightAndViolence.x;
  violence = heightAndViolence.y;
  vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
  // A pixel more, for the rounding of the rasteriser's grid.
  vec2 place = (disc.xy + corner * disc.w) / disc.z + corner * frame.forwardAndPixel.w;
  gl_Position = vec4(place / vec2(frame.rightAndSlope.w, frame.downAndSlope.w), 0.0, 1.0);
}
