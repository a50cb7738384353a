// A clear sky: a gradient from the horizon to the zenith, and the glow around the sun.
vec3 skyRadiance(vec3 direction) {
  // The square root keeps the bright band near the horizon narrow, as the thin air overhead does.
  float height = sqrt(clamp(direction.y, 0.0, 1.0));
  vec3 sky = mix(frame.skyHorizon.rgb, frame.skyZenith.rgb, height);
  float towardsSun = max(dot(direction, frame.sun.xyz), 0.0);
  vec3 warm = vec3(1.0, 0.86, 0.66);
  // Powers 8 and 96 by multiplying: a pow() for every pixel is what this pass would otherwise spend most of its time on.
  float p2 = towardsSun * towardsSun;
  float p4 = p2 * p2;
  float p8 = p4 * p4;
  float p32 = p8 * p8 * p8 * p8;
  float glow = 0.22 * p8 + 0.5 * p32 * p32 * p32;
  // Below the horizon, where there is no floor, the ground is a dimmer mirror of the band above it.
  float ground = smoothstep(0.0, -0.35, direction.y);
  return mix(sky + glow * warm, 0.55 * frame.skyHorizon.rgb, ground);
}
