// Needs surface.glsl. Surface normals from inverse depth: N = (q_X, q_Y, q − W·∇q) points away from the eye.

// Slope of q per pixel; at a silhouette the difference that stays on the surface, and of two that may, the smaller.
float slopeOf(float before, float q, float after, float edge) {
  float backward = q - before;
  float forward = after - q;
  bool hasBackward = onOneSurface(q, before, edge);
  bool hasForward = onOneSurface(q, after, edge);
  if (hasBackward && hasForward) return 0.5 * (backward + forward);
  if (hasBackward || hasForward) return hasBackward ? backward : forward;
  return 0.0;
}

// Unit normal in view space, towards the eye.
vec3 surfaceNormal(vec2 at, vec2 W, float q, float edge) {
  vec2 dx = vec2(frame.pictureSize.z, 0.0);
  vec2 dy = vec2(0.0, frame.pictureSize.w);
  vec2 gradient = vec2(slopeOf(inverseDepthAt(at - dx), q, inverseDepthAt(at + dx), edge),
                       slopeOf(inverseDepthAt(at - dy), q, inverseDepthAt(at + dy), edge)) / frame.forwardAndPixel.w;
  return -normalize(vec3(gradient, q - dot(W, gradient)));
}
