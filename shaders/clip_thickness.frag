// The most liquid that fits between its front and a body behind that; blended as a minimum.
#include "frame_uniforms.glsl"
#include "scene_depth.glsl"
#include "liquid_front.glsl"

in vec2 slope;
out float most;

void main() {
  // The lines of sight of the thickness, which may reach a little beyond the picture.
  vec2 W = slope * liquid.slopes.xy / frame.pictureSlopes.xy;
  float front = liquidFront(W);
  float body = bodyDepthAt(W);
  if (front <= 0.0 || body <= 0.0) discard;
  most = max(1.0 / body - 1.0 / front, 0.0) * length(vec3(W, 1.0));
}
