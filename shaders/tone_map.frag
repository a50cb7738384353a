// The picture as a screen shows it. The target encodes sRGB.
#include "tone.glsl"

layout(binding = 0) uniform sampler2D picture;
layout(location = 0) uniform float exposure;  // factor

in vec2 uv;
out vec4 colour;

void main() { colour = vec4(toneMap(max(exposure * texture(picture, uv).rgb, 0.0)), 1.0); }
