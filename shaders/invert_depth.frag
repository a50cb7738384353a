// Depth as inverse depth; 0 stays 0.
layout(binding = 0) uniform sampler2D depthMap;

in vec2 uv;
out float inverseDepth;

void main() {
  float depth = texture(depthMap, uv).r;
  inverseDepth = depth > 0.0 ? 1.0 / depth : 0.0;
}
