// The bodies over the background, or, with EDGES, what of a body's silhouette stands before liquid over the picture.
#include "frame_uniforms.glsl"
#include "body_samples.glsl"
#ifdef EDGES
#include "liquid_front.glsl"
#endif

in vec2 slope;
layout(location = 0, index = 0) out vec4 light;  // times coverage
layout(location = 0, index = 1) out vec4 cover;

void main() {
#ifdef EDGES
  float front = liquidFront(slope);
  if (front <= 0.0) discard;
#else
  const float front = 0.0;
#endif
  vec4 sum = vec4(0.0);
  float count = 0.0;
  for (int i = 0; i < samples; ++i) {
    if (sampleDepth(i) <= front) continue;
    sum += sampleLight(i);
    count += 1.0;
  }
  if (count < 0.5) discard;
#ifdef EDGES
  // Behind a whole pixel of bodies no liquid has been drawn.
  if (count > 3.5) discard;
  sum.a = count;
#endif
  light = 0.25 * sum;
  cover = vec4(0.25 * count);
}
