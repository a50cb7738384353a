// The bilateral filter on inverse depth over the whole disc of pixels (Tomasi & Manduchi 1998).
#include "frame_uniforms.glsl"
#include "surface.glsl"
#include "kernel.glsl"
#include "depth_weight.glsl"

layout(location = 0) uniform float deviation;       // σ of the Gaussian, m
layout(location = 1) uniform float depthDeviation;  // σ of the weight over differences of eye depth, m

in vec2 uv;
out float smoothed;

void main() {
  float q = inverseDepthAt(uv);
  // 16 samples to either side are at least two to a σ, mostly five, and 800 in all.
  Kernel kernel = kernelAt(q, deviation, 16.0);
  vec2 stride = kernel.stride * frame.pictureSize.zw;
  float depthExponent = depthExponentAt(q, depthDeviation);
  float sum = 0.0;
  float weights = 0.0;
  for (float j = -kernel.reach; j <= kernel.reach; ++j) {
    float width = floor(sqrt(kernel.reach * kernel.reach - j * j));
    for (float i = -width; i <= width; ++i) {
      float other = inverseDepthAt(uv + stride * vec2(i, j));
      float weight = bilateralWeight(kernel.exponent * (i * i + j * j), depthExponent, q, other);
      sum += weight * (other - q);
      weights += weight;
    }
  }
  smoothed = q + sum / weights;
}
