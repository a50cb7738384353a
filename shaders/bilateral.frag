// One direction of the separable bilateral filter (Pham & van Vliet 2005) on inverse depth. Planes, which are affine in
// q, stay as they are.
#include "frame_uniforms.glsl"
#include "surface.glsl"
#include "kernel.glsl"
#include "depth_weight.glsl"

layout(location = 0) uniform vec2 direction;        // one pixel along the picture's x or y, in texture coordinates
layout(location = 1) uniform float deviation;       // σ of the Gaussian, m
layout(location = 2) uniform float depthDeviation;  // σ of the weight over differences of eye depth, m

in vec2 uv;
out float smoothed;

void main() {
  float q = inverseDepthAt(uv);
  Kernel kernel = kernelAt(q, deviation, 48.0);
  vec2 stride = kernel.stride * direction;
  float depthExponent = depthExponentAt(q, depthDeviation);
  float sum = q;
  float weights = 1.0;
  for (float n = 1.0; n <= kernel.reach; ++n) {
    float before = inverseDepthAt(uv - n * stride);
    float after = inverseDepthAt(uv + n * stride);
    float exponent = kernel.exponent * n * n;
    float weightBefore = bilateralWeight(exponent, depthExponent, q, before);
    float weightAfter = bilateralWeight(exponent, depthExponent, q, after);
    sum += weightBefore * before + weightAfter * after;
    weights += weightBefore + weightAfter;
  }
  smoothed = sum / weights;
}
