// One explicit step of mean curvature flow on inverse depth q(W), after van der Laan, Green & Sainz 2009, with every
// term of the perspective kept and the sign that smooths:
//   q_t = A^{ij} q_ij,  A = ½ (q³/|N|) [ I + W Wᵀ − b bᵀ/|N|² ],  N = (q_X, q_Y, q − W·∇q),  b = ∇q − W·N_3
// (X, Y: view slopes). Planes are affine in q and stay exactly as they are.
#include "frame_uniforms.glsl"
#include "surface.glsl"

layout(location = 0) uniform float timeStep;  // m²
layout(location = 1) uniform float edge;      // step of depth that counts as a silhouette, m

in vec2 uv;
in vec2 slope;
out float smoothed;

// First and second difference along one axis. Across a silhouette the missing neighbour is the ghost 2q − q_opposite,
// which has no curvature and keeps planes; with both gone the profile is level.
vec2 differences(float before, float q, float after) {
  bool hasBefore = onOneSurface(q, before, edge);
  bool hasAfter = onOneSurface(q, after, edge);
  if (hasBefore && hasAfter) return vec2(0.5 * (after - before), after - 2.0 * q + before);
  if (hasBefore) return vec2(q - before, 0.0);
  if (hasAfter) return vec2(after - q, 0.0);
  return vec2(0.0);
}

void main() {
  vec2 dx = vec2(frame.pictureSize.z, 0.0);
  vec2 dy = vec2(0.0, frame.pictureSize.w);
  float q = inverseDepthAt(uv);
  vec2 alongX = differences(inverseDepthAt(uv - dx), q, inverseDepthAt(uv + dx));
  vec2 alongY = differences(inverseDepthAt(uv - dy), q, inverseDepthAt(uv + dy));

  float upLeft = inverseDepthAt(uv - dx - dy);
  float upRight = inverseDepthAt(uv + dx - dy);
  float downLeft = inverseDepthAt(uv - dx + dy);
  float downRight = inverseDepthAt(uv + dx + dy);
  bool corners = onOneSurface(q, upLeft, edge) && onOneSurface(q, upRight, edge) &&
                 onOneSurface(q, downLeft, edge) && onOneSurface(q, downRight, edge);
  float mixed = corners ? 0.25 * (downRight - downLeft - upRight + upLeft) : 0.0;

  float pixel = frame.forwardAndPixel.w;
  vec2 gradient = vec2(alongX.x, alongY.x) / pixel;
  vec3 second = vec3(alongX.y, mixed, alongY.y) / (pixel * pixel);  // q_XX, q_XY, q_YY
  vec2 W = slope;
  float n3 = q - dot(W, gradient);
  float squaredNormal = dot(gradient, gradient) + n3 * n3;
  vec2 b = gradient - W * n3;
  float laplacian = (1.0 + W.x * W.x) * second.x + 2.0 * W.x * W.y * second.y + (1.0 + W.y * W.y) * second.z;
  float along = (b.x * b.x * second.x + 2.0 * b.x * b.y * second.y + b.y * b.y * second.z) / squaredNormal;
  smoothed = q + timeStep * 0.5 * q * q * q * inversesqrt(squaredNormal) * (laplacian - along);
}
