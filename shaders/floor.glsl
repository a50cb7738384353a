// The checkered floor. A pixel sees the mean of the checker over its footprint: the box filter of each square wave,
// integrated in closed form, so that far tiles turn grey instead of flickering.

// Mean of ±1 tiles around p, in tiles, over a box of edges `width`.
float checker(vec2 p, vec2 width) {
  width = max(width, vec2(1e-4));
  vec2 integral = 2.0 * (abs(fract(0.5 * (p - 0.5 * width)) - 0.5) - abs(fract(0.5 * (p + 0.5 * width)) - 0.5));
  vec2 mean = integral / width;
  return mean.x * mean.y;
}

// Colour of the tiles at `point`; `footprint` is the pixel's box on the floor, m.
vec3 floorAlbedo(vec2 point, vec2 footprint) {
  float tile = frame.floorAndHaze.y;
  float side = checker(point / tile, footprint / tile);
  return mix(frame.tileDark.rgb, frame.tileLight.rgb, 0.5 + 0.5 * side);
}

// Light on the floor, as radiance of something white there: the sun's, and the sky's, of whose blue about half is taken
// back by what it shines on around, so that sunlit tiles keep their colour.
vec3 sunOnFloor() { return frame.sunlight.rgb * max(frame.sun.y, 0.0); }
vec3 skyOnFloor() { return 0.45 * mix(frame.skyHorizon.rgb, frame.skyZenith.rgb, 0.5); }

// How much of it is the sun's.
float sunShareOnFloor() {
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  float fromSun = dot(sunOnFloor(), luminance);
  return fromSun / max(fromSun + dot(skyOnFloor(), luminance), 1e-6);
}

// What the floor at `point` sends to an eye at `distance` m; `footprint` is the pixel's box on the floor, m.
vec3 floorRadiance(vec2 point, vec2 footprint, float distance, vec3 direction) {
  vec3 lit = floorAlbedo(point, footprint) * (sunOnFloor() + skyOnFloor());
  float far = distance / frame.floorAndHaze.w;
  float haze = 1.0 - exp(-far * far);
  // The floor vanishes into exactly what the sky shows at the horizon above it.
  vec3 level = normalize(vec3(direction.x, 0.0, direction.z) + vec3(1e-6, 0.0, 0.0));
  return mix(lit, skyRadiance(level), haze);
}
