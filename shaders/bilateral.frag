// One direction of the separable bilateral filter (Pham & van Vliet 2005) on inverse depth. The kernel's width is given
// in space, so that distant liquid is no smoother than near; planes, which are affine in q, stay as they are.
#include "frame_uniforms.glsl"
#include "surface.glsl"

layout(location = 0) uniform vec2 direction;        // one pixel along the picture's x or y, in texture coordinates
layout(location = 1) uniform float deviation;       // σ of the Gaussian, m
layout(location = 2) uniform float depthDeviation;  // σ of the weight over differences of eye depth, m

in vec2 uv;
out float smoothed;

const float kLargestReach = 48.0;  // pixels; bounds the cost of liquid right before the eye

void main() {
  float q = inverseDepthAt(uv);
  float deviationPixels = deviation * q / frame.forwardAndPixel.w;
  // 2.5 σ: the weight left out beyond is 1 %.
  float reach = min(ceil(2.5 * deviationPixels), kLargestReach);
  // Exponents to base 2: 0.7213475 = log2(e)/2.
  float spatial = -0.7213475 / max(deviationPixels * deviationPixels, 1e-6);
  // The difference of depths at first order: z_j − z ≈ (q − q_j)·z².
  float range = -0.7213475 / (depthDeviation * depthDeviation * q * q * q * q);
  float sum = q;
  float weights = 1.0;
  for (float i = 1.0; i <= reach; ++i) {
    float before = inverseDepthAt(uv - i * direction);
    float after = inverseDepthAt(uv + i * direction);
    float far = spatial * i * i;
    float weightBefore = before > 0.0 ? exp2(far + range * (before - q) * (before - q)) : 0.0;
    float weightAfter = after > 0.0 ? exp2(far + range * (after - q) * (after - q)) : 0.0;
    sum += weightBefore * before + weightAfter * after;
    weights += weightBefore + weightAfter;
  }
  smoothed = sum / weights;
}
