// The shaded liquid, coarser than the picture, between its pixels: colour times coverage, and coverage.
#include "frame_uniforms.glsl"

layout(binding = 0) uniform sampler2D liquid;
layout(location = 0) uniform vec2 liquidSlopes;  // largest |W_x|, |W_y| of the liquid's picture

in vec2 slope;
out vec4 colour;

void main() { colour = texture(liquid, 0.5 + 0.5 * slope / liquidSlopes); }
