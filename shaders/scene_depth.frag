// Depth of floor and bodies, of what covers a whole pixel: liquid behind a silhouette is drawn, and the silhouette over it.
#include "frame_uniforms.glsl"
#include "scene_depth.glsl"
#include "body_samples.glsl"

in vec2 slope;
out float q;

void main() {
  float farthest = sampleDepth(0);
  for (int i = 1; i < samples; ++i) farthest = min(farthest, sampleDepth(i));
  q = max(floorInverseDepth(slope), farthest);
}
