// Needs refraction.glsl and lighting.glsl. What comes from below the surface of clear liquid.
layout(binding = 2) uniform sampler2D thicknessMap;

float thicknessAt(vec2 W) { return texture(thicknessMap, 0.5 + 0.5 * W / liquid.slopes.xy).r; }

// Liquid ends round, within the last pixels of a splat, which smoothing leaves flat: where a line of sight passes no
// more than a ball of radius ρ holds, the surface turns away as that ball's does, T = 2ρ·cos θ, towards where the liquid
// gets thinner. So thin rims mirror and bend what is behind them, and end crisply.
vec3 roundedRim(vec3 normal, vec3 sight, float thickness) {
  float ball = 0.35 * liquid.splat.z;
  float cosine = min(thickness / (2.0 * ball), 1.0);
  vec3 outward = vec3(-dFdx(thickness), -dFdy(thickness), 0.0);
  outward -= dot(outward, sight) * sight;
  float size = length(outward);
  if (cosine >= 1.0 || size < 2.5e-7) return normal;
  vec3 round = outward / size * sqrt(1.0 - cosine * cosine) - cosine * sight;
  return normalize(mix(round, normal, cosine));
}

// What is behind, less what the liquid takes along the way (Beer–Lambert), and what it scatters back of the light that
// has come into it.
vec3 clearBody(Entry entry, vec3 worldNormal) {
  Transmitted through = transmitted(entry);
  vec3 transmittance = exp(-liquid.absorptionAndIndex.rgb * through.path);
  vec3 scattered = liquid.scatterAndShift.rgb * lightBelow(entry.origin, worldNormal, 0.5);
  return mix(scattered, through.radiance, transmittance);
}
