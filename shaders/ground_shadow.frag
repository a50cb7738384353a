// Darkens the floor where sunlight has passed liquid. The result multiplies what is there.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"

layout(binding = 0) uniform sampler2D shadowMap;  // liquid along the way to the sun, m

in vec3 view;
in vec2 mapPosition;
out vec4 factor;

void main() {
  float passed = texture(shadowMap, mapPosition).r;
  // The rest of the light on the floor comes from the sky and casts no shadow worth drawing.
  const float sunShare = 0.65;
  float covered = 1.0 - exp(-passed / (1.5 * liquid.splat.z));
#ifdef OPAQUE
  vec3 sunlight = vec3(1.0 - covered);
#else
  // What waves and rims of a clear liquid turn away from its own shadow.
  const float turnedAway = 0.75;
  vec3 sunlight = exp(-liquid.absorptionAndIndex.rgb * passed) * (1.0 - turnedAway * covered);
#endif
  float far = length(view) / frame.floorAndHaze.w;
  float strength = frame.shadow.x * sunShare * exp(-far * far);
  factor = vec4(1.0 - strength * (1.0 - sunlight), 1.0);
}
