// Spray, foam and bubbles over the picture: they hide what their optical depth tells, and are white in its place.
#include "frame_uniforms.glsl"
#include "environment.glsl"

layout(binding = 0) uniform sampler2D foam;
layout(location = 0) uniform vec3 foamColour;
layout(location = 1) uniform vec3 glow;  // of drops of a melt

in vec2 uv;
out vec4 colour;

float opticalDepthAt(vec2 at) { return texture(foam, at).r; }

void main() {
  float opticalDepth = opticalDepthAt(uv);
  if (opticalDepth <= 0.0) discard;
  float coverage = 1.0 - exp(-opticalDepth);

  // Dense foam stands out from thin foam: its heaps have a side towards the sun and one away from it.
  vec2 pixel = 1.5 * frame.pictureSize.zw;
  vec2 rise = vec2(opticalDepthAt(uv + vec2(pixel.x, 0.0)) - opticalDepthAt(uv - vec2(pixel.x, 0.0)),
                   opticalDepthAt(uv + vec2(0.0, pixel.y)) - opticalDepthAt(uv - vec2(0.0, pixel.y)));
  vec3 normal = toWorldDirection(normalize(vec3(-rise / (1.0 + opticalDepth), -1.0)));
  // Light goes astray in foam, so that what is turned from the sun is lit as well.
  float lit = 0.35 + 0.65 * max(0.0, 0.4 + 0.6 * dot(normal, frame.sun.xyz));
  vec3 skylight = (0.6 + 0.4 * normal.y) * ambientAbove();
  vec3 radiance = foamColour * (lit * frame.sunlight.rgb + skylight) + glow;
  colour = vec4(radiance * coverage, coverage);
}
