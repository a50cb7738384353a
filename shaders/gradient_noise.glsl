// Gradient noise [Perlin 2002, Improving Noise] on a lattice whose gradients are hashes of its points: no table, and a
// lattice for every seed. The same terms stand in server/render/noise_rows.cpp.

const uint kStepX = 0x9e3779b1u;
const uint kStepY = 0x85ebca77u;

float fade(float t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

// The gradient at a point of the lattice times the way from there.
float ramp(uint point, vec2 way) {
  point ^= point >> 15;
  point *= 0x2c1b3c6du;
  point ^= point >> 14;
  vec2 gradient = vec2(point & 0xffffu, point >> 16) * (2.0 / 65535.0) - 1.0;
  return dot(gradient, way);
}

// At a place with both coordinates above 0.
float gradientNoise(vec2 place, uint seed) {
  ivec2 cell = ivec2(place);
  vec2 within = place - vec2(cell);
  uint point = uint(cell.x) * kStepX + uint(cell.y) * kStepY + seed;
  float a = ramp(point, within);
  float b = ramp(point + kStepX, within - vec2(1.0, 0.0));
  float c = ramp(point + kStepY, within - vec2(0.0, 1.0));
  float d = ramp(point + kStepX + kStepY, within - vec2(1.0, 1.0));
  float u = fade(within.x);
  return mix(mix(a, b, u), mix(c, d, u), fade(within.y));
}
