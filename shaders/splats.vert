// A particle as a point that covers its sphere's outline.
#include "frame_uniforms.glsl"
#include "sphere.glsl"

layout(location = 0) in vec4 particle;  // centre in view space and radius, m
flat out vec4 sphere;

void main() {
  vec3 centre = particle.xyz;
  float radius = visibleRadius(particle.w, centre.z);
  sphere = vec4(centre, radius);

  // Bounds of the outline: W± = (x·z ± R·√(x²+z²−R²)) / (z²−R²), and likewise in y.
  float room = centre.z * centre.z - radius * radius;
  vec2 middle = centre.xy * (centre.z / room);
  vec2 halfExtent = sqrt(centre.xy * centre.xy + room) * (radius / room);
  vec2 pixel = middle / target.x + 0.5 * target.yz;
  gl_Position = vec4(2.0 * (pixel + target.w) / (target.yz + 2.0 * target.w) - 1.0, 0.0, 1.0);
  // A tenth of a pixel for the rounding of the rasteriser's grid.
  gl_PointSize = 2.0 * max(halfExtent.x, halfExtent.y) / target.x + 0.1;
}
