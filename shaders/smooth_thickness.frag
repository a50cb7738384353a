// One direction in which the liquid's thickness evens out; thickness_smoothing.h describes it, and is the same on the
// CPU.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "surface.glsl"

layout(binding = 1) uniform sampler2D thicknessMap;
layout(location = 0) uniform vec2 direction;      // one pixel of the thickness along x or y, in texture coordinates
layout(location = 1) uniform float scale;         // ρ at inverse depth 1, pixels of the thickness

in vec2 uv;
out float smoothed;

const float kLargestReach = 16.0;  // see ThicknessSmoothing::kLargestReach

float change(float neighbour, float own) { return neighbour > 0.0 ? neighbour - own : 0.0; }

void main() {
  float own = texture(thicknessMap, uv).r;
  smoothed = 0.0;
  if (own <= 0.0) return;
  vec2 W = (2.0 * uv - 1.0) * liquid.slopes.xy;
  // At the rim, where a pixel's middle may have no surface, there is no depth to go by.
  float reach = min(scale * inverseDepthAt(0.5 + 0.5 * W / liquid.slopes.zw), kLargestReach);
  float inverseSquare = reach > 0.0 ? 1.0 / (reach * reach) : 1e6;
  float sum = 0.0;
  float weights = 1.0;
  for (float i = 1.0; i <= ceil(reach); ++i) {
    float root = max(1.0 - i * i * inverseSquare, 0.0);
    float weight = root * root;
    float before = texture(thicknessMap, uv - i * direction).r;
    float after = texture(thicknessMap, uv + i * direction).r;
    sum += weight * (change(before, own) + change(after, own));
    weights += 2.0 * weight;
  }
  smoothed = own + sum / weights;
}
