// A particle as a rectangle that covers its sphere's outline: for spheres larger than a point may be, or that reach
// nearer than the near depth, whose outline may fill any part of the picture.
#include "frame_uniforms.glsl"
#include "sphere.glsl"

layout(location = 0) in vec4 particle;  // centre in view space and radius, m
flat out vec4 sphere;

void main() {
  vec3 centre = particle.xyz;
  float radius = visibleRadius(particle.w, centre.z);
  sphere = vec4(centre, radius);

  vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
  vec2 place = corner;
  if (centre.z - radius >= frame.eyeAndNear.w) {
    float room = centre.z * centre.z - radius * radius;
    vec2 middle = centre.xy * (centre.z / room);
    vec2 halfExtent = sqrt(centre.xy * centre.xy + room) * (radius / room);
    place = (middle + corner * (halfExtent + target.x)) / vec2(frame.rightAndSlope.w, frame.downAndSlope.w);
  }
  gl_Position = vec4(place, 0.0, 1.0);
}
