// The liquid over the scene: what it reflects, what it lets through, what it sends back from inside.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "picture_place.glsl"
#include "scene_depth.glsl"
#include "scene_lights.glsl"
#include "surface.glsl"
#include "normal.glsl"
#include "coverage.glsl"
#include "fresnel.glsl"
#include "interface.glsl"
#include "reflections.glsl"
#include "lighting.glsl"
#ifndef OPAQUE
#include "refraction.glsl"
#include "clear_body.glsl"
#endif
#ifdef NOISE
#include "surface_noise.glsl"
#endif

in vec2 uv;
in vec2 slope;
out vec4 colour;

// What comes from below an opaque surface.
vec3 opaqueBody(vec3 point, vec3 normal, float cosine) {
  vec3 body = liquid.colourAndDiffuse.rgb * lightBelow(point, normal, 0.15);
#ifdef EMISSION
  // A melt glows through a skin that has cooled down, of which an oblique line of sight passes more.
  const float skin = 0.4;
  vec3 glow = liquid.emission.rgb * exp(skin - skin / max(cosine, 0.05));
#ifdef NOISE
  glow *= throughCrust(uv);
#endif
  body += glow;
#endif
  return body;
}

void main() {
  float q = inverseDepthAt(uv);
  vec3 P = vec3(slope, 1.0) / q;
  vec3 sight = normalize(vec3(slope, 1.0));
  vec3 normal = surfaceNormal(uv, slope, q, 3.0 * liquid.splat.x);
#ifndef OPAQUE
  float thickness = thicknessAt(slope);
  float slabCosine = clamp(-dot(normal, sight), 0.0, 1.0);
  normal = roundedRim(normal, sight, thickness);
#endif
#ifdef NOISE
  normal = roughened(normal, uv, slope, q);
#endif
  float cosine = clamp(-dot(normal, sight), 0.0, 1.0);
  vec3 worldNormal = toWorldDirection(normal);
  vec3 worldSight = toWorldDirection(sight);
  vec3 origin = frame.eye.xyz + toWorldDirection(P);

  vec3 body = vec3(0.0);
#if defined(OPAQUE) && !defined(METAL)
  body = opaqueBody(origin, worldNormal, cosine);
#elif !defined(OPAQUE)
  body = clearBody(Entry(P, sight, normal, cosine, slabCosine, thickness, slope, origin), worldNormal);
#endif
#ifdef PHONG
  body = mix(body, liquid.colourAndDiffuse.rgb * lightBelow(origin, worldNormal, 0.0), liquid.colourAndDiffuse.w);
#endif

  vec3 mirrored = reflectanceAt(cosine);
#ifdef NO_REFLECTION
  vec3 radiance = body * (1.0 - mirrored);
#else
  vec3 radiance = mix(body, reflectedRadiance(origin, reflect(worldSight, worldNormal)), mirrored);
#endif
#ifdef HIGHLIGHT
  radiance += highlights(origin, worldNormal, -worldSight);
#endif
#ifdef WHITENING
  radiance = whitened(radiance, uv, worldNormal);
#endif
  float coverage = covered(uv);
  // 6·10⁴: half floats end at 65504.
  colour = vec4(min(radiance, 6e4) * coverage, coverage);
}
