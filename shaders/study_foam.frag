// How much of what is behind spray, foam and bubbles hide, as colours over the liquid's, which are those of none.
#include "palette.glsl"

layout(binding = 0) uniform sampler2D foam;  // optical depth

in vec2 uv;
out vec4 colour;

void main() {
  float share = 1.0 - exp(-texture(foam, uv).r);
  // Over the liquid so little looks like none anyway; beside it drops end softly.
  float cover = smoothstep(0.0, 0.05, share);
  colour = vec4(cover * paletteColour(share), cover);
}
