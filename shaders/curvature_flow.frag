// One explicit step of mean curvature flow on inverse depth.
#include "frame_uniforms.glsl"
#include "surface.glsl"
#include "flow_rate.glsl"

layout(location = 0) uniform float timeStep;  // m²
layout(location = 1) uniform float edge;      // step of depth that counts as a silhouette, m

in vec2 uv;
in vec2 slope;
out float smoothed;

void main() { smoothed = inverseDepthAt(uv) + timeStep * flowRate(uv, slope, edge); }
