// Lets the stencil be written where there is liquid, or, with BODIES, where a body stands before it, or, with LAYERED,
// where so many other liquids are behind it.
#ifdef LAYERED
#include "layers.glsl"
in vec2 slope;
#endif
#ifdef BODIES
#include "frame_uniforms.glsl"
#include "scene_depth.glsl"
in vec2 slope;
#endif
layout(binding = 0) uniform sampler2D surface;

in vec2 uv;

void main() {
  float q = texture(surface, uv).r;
#ifdef BODIES
  if (bodyDepthAt(slope) <= q) discard;
#elif defined(LAYERED)
  if (!isOfLayer(slope, q)) discard;
#else
  if (q <= 0.0) discard;
#endif
}
