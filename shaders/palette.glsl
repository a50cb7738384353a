// Colours that stand for values, in the middles of the texels of a row: from the least value's to the most's.
layout(binding = 2) uniform sampler2D palette;

// `share` is 0 at the least value and 1 at the most; beyond, it is as if it were at that end.
vec3 paletteColour(float share) {
  float size = float(textureSize(palette, 0).x);
  return texture(palette, vec2((clamp(share, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.5)).rgb;
}
