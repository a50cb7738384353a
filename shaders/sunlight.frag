// Sunlight on the floor where it has passed liquid: its shadow, and the light that it focuses.
#include "frame_uniforms.glsl"

layout(binding = 0) uniform sampler2D background;  // alpha: the share that comes straight from the sun
layout(binding = 1) uniform sampler2D lightMap;    // factor of the sunlight behind the liquid

in vec2 mapPosition;
out vec4 colour;

void main() {
  vec4 lit = texelFetch(background, ivec2(gl_FragCoord.xy), 0);
  vec3 factor = texture(lightMap, mapPosition).rgb;
  float sunlight = frame.lightCorner.w * lit.a;
  colour = vec4(lit.rgb * (1.0 + sunlight * (factor - 1.0)), lit.a);
}
