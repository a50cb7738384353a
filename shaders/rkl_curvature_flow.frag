// One stage of a Runge–Kutta–Legendre step of mean curvature flow on inverse depth (Meyer, Balsara & Aslam 2014): the
// weighted sum of the surfaces two, one and no stages before, and of the flow's rates there. Surfaces are given as
// differences from the one that the step began with, which is what keeps them exact to round-off: the weights of many
// stages grow large and cancel. With RATE the flow's rate alone, where a step begins.
#include "frame_uniforms.glsl"
#include "surface.glsl"
#include "flow_rate.glsl"

layout(binding = 1) uniform sampler2D start;      // Y_0
layout(binding = 2) uniform sampler2D before;     // Y_{j−2}
layout(binding = 3) uniform sampler2D startRate;  // q_t at Y_0

layout(location = 0) uniform vec4 weights;  // of Y_{j−1}, Y_{j−2}, q_t at Y_{j−1} and at Y_0; of the rates in m²
layout(location = 1) uniform float edge;    // step of depth that counts as a silhouette, m

in vec2 uv;
in vec2 slope;
out float smoothed;

void main() {
#ifdef RATE
  smoothed = flowRate(uv, slope, edge);
#else
  float q0 = texture(start, uv).r;
  // The first stage takes what RATE has left in startRate.
  float rate = weights.z == 0.0 ? 0.0 : flowRate(uv, slope, edge);
  smoothed = q0 + weights.x * (inverseDepthAt(uv) - q0) + weights.y * (texture(before, uv).r - q0) + weights.z * rate +
             weights.w * texture(startRate, uv).r;
#endif
}
