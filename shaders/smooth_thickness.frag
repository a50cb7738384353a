// One direction of a Gaussian over the liquid's thickness. Its width is given in space, so that distant liquid is no
// smoother than near.
#include "frame_uniforms.glsl"
#include "surface.glsl"

layout(binding = 1) uniform sampler2D thicknessMap;
layout(location = 0) uniform vec2 direction;   // one pixel of the thickness along x or y, in texture coordinates
layout(location = 1) uniform float deviation;  // σ over the thickness' pixel slope, m
layout(location = 2) uniform vec2 surfaceSlopes;  // largest |W_x|, |W_y| of the surface

in vec2 uv;
out float smoothed;

const float kLargestReach = 16.0;  // pixels; bounds the cost of liquid right before the eye

void main() {
  float thickness = texture(thicknessMap, uv).r;
  vec2 W = (2.0 * uv - 1.0) * frame.otherSlopes.zw;
  // A pixel without a surface of its own, at the rim, has no depth to go by and stays as it is.
  float q = inverseDepthAt(0.5 + 0.5 * W / surfaceSlopes);
  float pixels = deviation * q;
  float reach = min(ceil(2.0 * pixels), kLargestReach);
  float spatial = -0.7213475 / max(pixels * pixels, 1e-6);  // log2(e)/2
  float sum = thickness;
  float weights = 1.0;
  for (float i = 1.0; i <= reach; ++i) {
    float weight = exp2(spatial * i * i);
    float before = texture(thicknessMap, uv - i * direction).r;
    float after = texture(thicknessMap, uv + i * direction).r;
    // Liquid alone counts, or rims would thin out.
    sum += weight * (before + after);
    weights += weight * (float(before > 0.0) + float(after > 0.0));
  }
  smoothed = thickness > 0.0 ? sum / weights : 0.0;
}
