// A clear sky: a gradient from the horizon to the zenith, and the glow around the sun.
vec3 skyRadiance(vec3 direction) {
  // The square root keeps the bright band near the horizon narrow, as the thin air overhead does.
  float height = sqrt(clamp(direction.y, 0.0, 1.0));
  vec3 sky = mix(frame.skyHorizon.rgb, frame.skyZenith.rgb, height);
  float towardsSun = max(dot(direction, frame.sun.xyz), 0.0);
  vec3 warm = vec3(1.0, 0.86, 0.66);
  float glow = 0.22 * pow(towardsSun, 8.0) + 0.5 * pow(towardsSun, 96.0);
  // Below the horizon, where there is no floor, the ground is a dimmer mirror of the band above it.
  float ground = smoothstep(0.0, -0.35, direction.y);
  return mix(sky + glow * warm, 0.55 * frame.skyHorizon.rgb, ground);
}
