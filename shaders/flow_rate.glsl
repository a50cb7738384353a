// Needs frame_uniforms.glsl and surface.glsl. Mean curvature flow on inverse depth q(W), after van der Laan, Green & Sainz
// 2009, with every term of the perspective kept and the sign that smooths:
//   q_t = A^{ij} q_ij,  A = ½ (q³/|N|) [ I + W Wᵀ − b bᵀ/|N|² ],  N = (q_X, q_Y, q − W·∇q),  b = ∇q − W·N_3
// (X, Y: view slopes). Planes are affine in q and stay exactly as they are. The same terms stand in explicit_flow_rows.cpp.

// First and second difference along one axis, and whether both neighbours are there. Across a silhouette the missing
// neighbour is the ghost 2q − q_opposite, which has no curvature and keeps planes; with both gone the profile is level.
struct Differences {
  float first;
  float second;
  bool inner;
};

Differences differences(float before, float q, float after, float edge) {
  bool hasBefore = onOneSurface(q, before, edge);
  bool hasAfter = onOneSurface(q, after, edge);
  if (hasBefore && hasAfter) return Differences(0.5 * (after - before), after - 2.0 * q + before, true);
  if (hasBefore) return Differences(q - before, 0.0, false);
  if (hasAfter) return Differences(after - q, 0.0, false);
  return Differences(0.0, 0.0, false);
}

// q_t at a pixel with view slope W, 1/m³; `edge` is the step of depth that counts as a silhouette, m.
float flowRate(vec2 at, vec2 W, float edge) {
  vec2 dx = vec2(frame.pictureSize.z, 0.0);
  vec2 dy = vec2(0.0, frame.pictureSize.w);
  float q = inverseDepthAt(at);
  Differences alongX = differences(inverseDepthAt(at - dx), q, inverseDepthAt(at + dx), edge);
  Differences alongY = differences(inverseDepthAt(at - dy), q, inverseDepthAt(at + dy), edge);

  float upLeft = inverseDepthAt(at - dx - dy);
  float upRight = inverseDepthAt(at + dx - dy);
  float downLeft = inverseDepthAt(at - dx + dy);
  float downRight = inverseDepthAt(at + dx + dy);
  // Beside a silhouette the mixed term alone would be no diffusion.
  bool inner = alongX.inner && alongY.inner && onOneSurface(q, upLeft, edge) && onOneSurface(q, upRight, edge) &&
               onOneSurface(q, downLeft, edge) && onOneSurface(q, downRight, edge);
  float mixed = inner ? 0.25 * (downRight - downLeft - upRight + upLeft) : 0.0;

  float pixel = frame.forwardAndPixel.w;
  vec2 gradient = vec2(alongX.first, alongY.first) / pixel;
  vec3 second = vec3(alongX.second, mixed, alongY.second) / (pixel * pixel);  // q_XX, q_XY, q_YY
  float n3 = q - dot(W, gradient);
  float squaredNormal = dot(gradient, gradient) + n3 * n3;
  vec2 b = gradient - W * n3;
  float laplacian = (1.0 + W.x * W.x) * second.x + 2.0 * W.x * W.y * second.y + (1.0 + W.y * W.y) * second.z;
  float along = (b.x * b.x * second.x + 2.0 * b.x * b.y * second.y + b.y * b.y * second.z) / squaredNormal;
  return 0.5 * q * q * q * inversesqrt(squaredNormal) * (laplacian - along);
}
