// The shaded liquid, coarser than the picture, between its pixels: colour times coverage, and coverage.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"

layout(binding = 0) uniform sampler2D shadedLiquid;

in vec2 slope;
out vec4 colour;

void main() { colour = texture(shadedLiquid, 0.5 + 0.5 * slope / liquid.slopes.zw); }
