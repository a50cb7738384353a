// A secondary particle as a point: as large as its dot, and as faint as its depth below the liquid's surface makes it.
// Mirrors discOf in server/render/foam_dots.cpp.
layout(location = 0) uniform vec4 target;    // pixel slope, width, height, margin of the viewport, pixels
layout(location = 1) uniform int liquids;
layout(location = 2) uniform float bed;      // m
layout(location = 3) uniform int bodies;     // 1 where some may hide foam, else 0
layout(location = 4) uniform vec2 slopes[8];  // largest |W_x|, |W_y| of each liquid's surface
layout(binding = 0) uniform sampler2D surfaces[8];
layout(binding = 8) uniform sampler2D sceneDepth;

layout(location = 0) in vec4 dot_;           // middle in view space and radius, m
layout(location = 1) in vec2 opacityAndFading;

flat out vec4 disc;                          // middle and radius, pixels; optical depth in the middle

// Whether a body stands before the dot. What lies on one is seen, though its middle may be a little inside.
bool isHidden(vec2 middle) {
  ivec2 size = textureSize(sceneDepth, 0);
  return bodies != 0 && texelFetch(sceneDepth, clamp(ivec2(middle), ivec2(0), size - 1), 0).r * dot_.z > 1.01;
}

void main() {
  vec2 slope = dot_.xy / dot_.z;
  float nearest = 0.0;
  for (int i = 0; i < liquids; ++i) {
    ivec2 size = textureSize(surfaces[i], 0);
    ivec2 pixel = ivec2((0.5 + 0.5 * slope / slopes[i]) * vec2(size));
    nearest = max(nearest, texelFetch(surfaces[i], clamp(pixel, ivec2(0), size - 1), 0).r);
  }
  float below = nearest > 0.0 ? max(0.0, dot_.z - 1.0 / nearest - bed) : 0.0;
  float pixels = dot_.w / (dot_.z * target.x);
  // A soft dot that is smaller flickers as it moves from pixel to pixel.
  float drawn = max(pixels, 1.25);
  float widening = pixels / drawn;
  vec2 middle = slope / target.x + 0.5 * target.yz;
  float opacity = isHidden(middle) ? 0.0 : opacityAndFading.x;
  disc = vec4(middle, drawn, opacity * exp(-opacityAndFading.y * below) * widening * widening);
  gl_Position = vec4((2.0 * middle - target.yz) / (target.yz + 2.0 * target.w), 0.0, 1.0);
  gl_PointSize = 2.0 * drawn + 2.0;
}
