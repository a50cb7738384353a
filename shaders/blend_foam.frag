// Spray, foam and bubbles over the picture: they hide what their optical depth tells, and are white in its place.
layout(binding = 0) uniform sampler2D foam;
layout(location = 0) uniform vec3 radiance;

in vec2 uv;
out vec4 colour;

void main() {
  float opticalDepth = texture(foam, uv).r;
  if (opticalDepth <= 0.0) discard;
  float coverage = 1.0 - exp(-opticalDepth);
  colour = vec4(radiance * coverage, coverage);
}
