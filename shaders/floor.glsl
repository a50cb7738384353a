// Needs environment.glsl. The checkered floor. A pixel sees the mean of the checker over its footprint: the box filter of each square wave,
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

// The way from a floor that is seen in `direction`, but level: what is seen there, the floor vanishes into.
vec3 levelled(vec3 direction) { return normalize(vec3(direction.x, 0.0, direction.z) + vec3(1e-6, 0.0, 0.0)); }

// What the floor at `point` sends to an eye at `distance` m; `footprint` is the pixel's box on the floor, m, `horizon`
// what it vanishes into.
vec3 floorRadiance(vec2 point, vec2 footprint, float distance, vec3 horizon) {
  float far = distance / frame.floorAndHaze.w;
  return mix(horizon, floorAlbedo(point, footprint) * frame.floorLight.rgb, exp(-far * far));
}
