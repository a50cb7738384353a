// One explicit step of curvature flow in eye depth as van der Laan, Green & Sainz 2009 print it, with the sign mended:
//   D = C²z_x² + C²z_y² + C⁴z²,  E_x = ½ z_x D_x − z_xx D,  2H = C (E_x + E_y)/D^{3/2},  z_t = −H
// (their Eqs. (5) to (8); x, y and t count pixels). H has the unit 1/pixel, so that what a step does depends on the
// picture's size and on the distance. The terms with the pixel's place in the picture are dropped as there: planes bend.
#include "frame_uniforms.glsl"
#include "surface.glsl"

layout(location = 0) uniform float timeStep;  // m·pixel
layout(location = 1) uniform float edge;      // step of depth that counts as a silhouette, m

in vec2 uv;
out float smoothed;

// First and second difference of depth along one axis, both forced to 0 at a silhouette.
vec2 differences(float before, float q, float after, out bool inner) {
  inner = onOneSurface(q, before, edge) && onOneSurface(q, after, edge);
  if (!inner) return vec2(0.0);
  return vec2(0.5 * (1.0 / after - 1.0 / before), 1.0 / after - 2.0 / q + 1.0 / before);
}

void main() {
  vec2 dx = vec2(frame.pictureSize.z, 0.0);
  vec2 dy = vec2(0.0, frame.pictureSize.w);
  float q = inverseDepthAt(uv);
  float z = 1.0 / q;
  bool innerX;
  bool innerY;
  vec2 alongX = differences(inverseDepthAt(uv - dx), q, inverseDepthAt(uv + dx), innerX);
  vec2 alongY = differences(inverseDepthAt(uv - dy), q, inverseDepthAt(uv + dy), innerY);
  float upLeft = inverseDepthAt(uv - dx - dy);
  float upRight = inverseDepthAt(uv + dx - dy);
  float downLeft = inverseDepthAt(uv - dx + dy);
  float downRight = inverseDepthAt(uv + dx + dy);
  bool inner = innerX && innerY && onOneSurface(q, upLeft, edge) && onOneSurface(q, upRight, edge) &&
               onOneSurface(q, downLeft, edge) && onOneSurface(q, downRight, edge);
  float mixed = inner ? 0.25 * (1.0 / downRight - 1.0 / downLeft - 1.0 / upRight + 1.0 / upLeft) : 0.0;

  float c = frame.forwardAndPixel.w;
  // D and its derivatives divided by C², and E with them, which leaves H = ½ (E_x + E_y)/D^{3/2}: C⁴ underflows early.
  float d = alongX.x * alongX.x + alongY.x * alongY.x + c * c * z * z;
  float dDx = 2.0 * (alongX.x * alongX.y + alongY.x * mixed + c * c * z * alongX.x);
  float dDy = 2.0 * (alongX.x * mixed + alongY.x * alongY.y + c * c * z * alongY.x);
  float ex = 0.5 * alongX.x * dDx - alongX.y * d;
  float ey = 0.5 * alongY.x * dDy - alongY.y * d;
  float h = 0.5 * (ex + ey) / (d * sqrt(d));
  // A step stays within a factor of two of the depth, as nothing else keeps it from passing through the eye.
  smoothed = 1.0 / clamp(z - timeStep * h, 0.5 * z, 2.0 * z);
}
