// One direction of a Gaussian over the liquid's pixels, on inverse depth. It takes no notice of silhouettes inside the
// liquid.
#include "frame_uniforms.glsl"
#include "surface.glsl"
#include "kernel.glsl"

layout(location = 0) uniform vec2 direction;   // one pixel along the picture's x or y, in texture coordinates
layout(location = 1) uniform float deviation;  // σ, m

in vec2 uv;
out float smoothed;

void main() {
  float q = inverseDepthAt(uv);
  Kernel kernel = kernelAt(q, deviation, 48.0);
  vec2 stride = kernel.stride * direction;
  float sum = q;
  float weights = 1.0;
  for (float n = 1.0; n <= kernel.reach; ++n) {
    float before = inverseDepthAt(uv - n * stride);
    float after = inverseDepthAt(uv + n * stride);
    float weight = exp2(kernel.exponent * n * n);
    sum += weight * (before + after);  // 0 where there is no liquid
    weights += weight * (float(before > 0.0) + float(after > 0.0));
  }
  smoothed = sum / weights;
}
