// Inverse eye depth of the nearest liquid along a line of sight; 0 where there is none. Needs frame_uniforms.glsl.
#include "liquid_uniforms.glsl"
#include "surface.glsl"
#ifdef LAYERED
#include "layers.glsl"
#endif

float liquidFront(vec2 W) {
  float q = 0.0;
#ifdef LIQUID
  q = inverseDepthAt(0.5 + 0.5 * W / liquid.slopes.zw);
#endif
#ifdef LAYERED
  q = max(q, nearestOther(W));
#endif
  return q;
}
