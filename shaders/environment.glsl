// Needs frame_uniforms.glsl. What surrounds the scene: whatever it is, one picture of all directions, see
// EnvironmentPicture in server/render/environment.h, and the light that it sheds.
layout(binding = 24) uniform sampler2D environmentPicture;

// Place of a direction of length 1 in the picture: an octahedron whose upper half fills the inner diamond, unfolded.
vec2 octahedral(vec3 direction) {
  vec2 p = direction.xz / (abs(direction.x) + abs(direction.y) + abs(direction.z));
  if (direction.y < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return 0.5 + 0.5 * p;
}

vec3 environmentRadiance(vec3 direction) { return texture(environmentPicture, octahedral(direction)).rgb; }

// What is seen of it straight away: a backdrop is seen, and is no light.
vec3 backgroundRadiance(vec3 direction) {
  return mix(environmentRadiance(direction), frame.backdrop.rgb, frame.backdrop.w);
}

// The same light on what faces upwards, for less than ambientLight() takes.
vec3 ambientAbove() { return frame.floorLight.rgb - frame.sunlight.rgb * max(frame.sun.y, 0.0); }

// Radiance of a white matte surface with unit normal n under the environment alone: irradiance/π from the first nine
// spherical harmonics [Ramamoorthi & Hanrahan 2001], as polynomials in n.
vec3 ambientLight(vec3 n) {
  vec4 first = vec4(n, 1.0);
  vec4 second = n.xyzz * n.yzzx;
  return max(vec3(dot(frame.ambientRed, first), dot(frame.ambientGreen, first), dot(frame.ambientBlue, first)) +
             vec3(dot(frame.ambientRed2, second), dot(frame.ambientGreen2, second), dot(frame.ambientBlue2, second)) +
             frame.ambientPlane.rgb * (n.x * n.x - n.y * n.y), 0.0);
}
