// One direction of the binomial filter of linear depth (Cords & Staadt 2008), with their silhouette map: liquid whose
// filter has met background is marked by its sign on the way, and given up in the end.
#include "frame_uniforms.glsl"
#include "surface.glsl"

layout(location = 0) uniform vec2 direction;   // one pixel along the picture's x or y, in texture coordinates
layout(location = 1) uniform float deviation;  // σ, m
layout(location = 2) uniform bool last;        // the second direction of two
layout(location = 3) uniform bool erodes;      // with the silhouette map

in vec2 uv;
out float smoothed;

// Bounds the cost of liquid right before the eye, pixels.
const float kLargestReach = 128.0;

void main() {
  float q = inverseDepthAt(uv);
  float depth = 1.0 / abs(q);
  // Background bleeds in as if it lay as far behind the liquid as that is from the eye: linear depth has no far plane.
  float background = 2.0 * depth;
  float pixels = deviation / (depth * frame.forwardAndPixel.w);
  // The weights C(2m, m+i), of variance m/2, by C(2m, m+i+1)/C(2m, m+i) = (m−i)/(m+i+1), which also holds between whole
  // orders, so that the order follows depth without steps.
  float m = 2.0 * pixels * pixels;
  // Up to 3 σ: what lies beyond is less than the smoothed map shows in eight bits.
  float reach = min(min(ceil(3.0 * pixels), kLargestReach), ceil(m));
  float sum = depth;
  float weights = 1.0;
  float weight = 1.0;
  float missing = q < 0.0 ? 1.0 : 0.0;
  for (float i = 0.0; i < reach; ++i) {
    weight *= (m - i) / (m + i + 1.0);
    float before = inverseDepthAt(uv - (i + 1.0) * direction);
    float after = inverseDepthAt(uv + (i + 1.0) * direction);
    missing += weight * (float(before <= 0.0) + float(after <= 0.0));
    sum += weight * ((before == 0.0 ? background : 1.0 / abs(before)) + (after == 0.0 ? background : 1.0 / abs(after)));
    weights += 2.0 * weight;
  }
  smoothed = weights / sum;
  // Half of the last of eight bits: the map, smoothed like the depth, is not 1.
  bool metBackground = missing > weights / 512.0;
  if (metBackground) smoothed = !last ? -smoothed : erodes ? 0.0 : smoothed;
}
