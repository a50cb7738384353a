// Lets the stencil be written where there is liquid.
layout(binding = 0) uniform sampler2D surface;

in vec2 uv;

void main() {
  if (texture(surface, uv).r <= 0.0) discard;
}
