// A matte surface with a soft sheen, in the light of sun, sky, floor and lamps.
#ifdef SHADOW
void main() {}
#else
#include "frame_uniforms.glsl"
#include "scene_lights.glsl"
#include "reflections.glsl"
#include "lamps.glsl"
#include "body_shadow.glsl"

layout(location = 1) uniform vec4 colourAndRoughness;

in vec3 point;
in vec3 normal;
layout(location = 0) out vec4 colour;  // linear light; alpha: the share that comes straight from the sun
#ifdef CUBE_MAP
layout(location = 1) out vec2 inverseDistance;  // 1/m, and 1
#endif

// GGX sheen of a dielectric (reflectance 0.04) times the cosine, for a white light of unit radiance on white:
// π·D·V·F·cos with Smith's height-correlated visibility V.
float sheen(vec3 n, vec3 towardsEye, vec3 towardsLight, float alpha) {
  vec3 h = normalize(towardsEye + towardsLight);
  float nl = max(dot(n, towardsLight), 0.0);
  float nv = max(dot(n, towardsEye), 1e-3);
  float nh = max(dot(n, h), 0.0);
  float a2 = alpha * alpha;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float visibility = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2) + 1e-6);
  float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(towardsEye, h), 0.0), 5.0);
  return a2 / (d * d) * visibility * fresnel * nl;
}

void main() {
#ifdef SCREEN_SPACE_NORMALS
  vec3 n = normalize(cross(dFdx(point), dFdy(point)));
#else
  vec3 n = normalize(normal);
#endif
  vec3 towardsEye = normalize(frame.eye.xyz - point);
  // Both sides of what is open are seen.
  if (dot(n, towardsEye) < 0.0) n = -n;

  vec3 albedo = colourAndRoughness.rgb;
  float alpha = colourAndRoughness.w;
  float facing = max(dot(n, frame.sun.xyz), 0.0);
  float seen = facing > 0.0 ? mix(1.0, sunlightPastBodies(point, n), lights.sunlight.w) : 0.0;
  vec3 sunlit = lights.sunlight.rgb * seen * (albedo * facing + sheen(n, towardsEye, frame.sun.xyz, alpha));
  // Near the floor, half of what a wall sees of the sky is hidden by what stands beside it.
  float above = abs(point.y - frame.floorAndHaze.x);
  float open = frame.floorAndHaze.z > 0.5 ? mix(0.55, 1.0, smoothstep(0.0, 0.12, above + 0.1 * max(n.y, 0.0))) : 1.0;
  float grazing = 0.04 + 0.96 * pow(1.0 - max(dot(n, towardsEye), 0.0), 5.0);
  vec3 mirrored = environmentRadiance(reflect(-towardsEye, n)) * grazing * (1.0 - alpha) * (1.0 - alpha);
  vec3 rest = albedo * (open * skylight(n) + lampsOn(point, n)) + open * mirrored;
  vec3 radiance = sunlit + rest;
#ifdef CUBE_MAP
  colour = vec4(radiance, 1.0);
  inverseDistance = vec2(1.0 / max(distance(frame.eye.xyz, point), 1e-6), 1.0);
#else
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  colour = vec4(radiance, dot(sunlit, luminance) / max(dot(radiance, luminance), 1e-6));
#endif
}
#endif
