// Lets the stencil be written where there is liquid, and no body before it.
#ifdef BODIES
#include "frame_uniforms.glsl"
#include "scene_depth.glsl"
in vec2 slope;
#endif
layout(binding = 0) uniform sampler2D surface;

in vec2 uv;

void main() {
  float q = texture(surface, uv).r;
  if (q <= 0.0) discard;
#ifdef BODIES
  if (bodyDepthAt(slope) > q) discard;
#endif
}
