// Needs surface.glsl. Silhouettes.

// Share of a pixel of the liquid that the liquid covers, judged by how many of its neighbours hold any (weights 1 2 1 by
// 1 2 1): 5/6 along a straight silhouette, so that steps of the outline are soft, and never so little that a drop of a
// single pixel is lost.
float covered(vec2 at) {
  vec2 dx = vec2(frame.pictureSize.z, 0.0);
  vec2 dy = vec2(0.0, frame.pictureSize.w);
  vec4 sides = vec4(inverseDepthAt(at - dx), inverseDepthAt(at + dx), inverseDepthAt(at - dy), inverseDepthAt(at + dy));
  vec4 corners = vec4(inverseDepthAt(at - dx - dy), inverseDepthAt(at + dx - dy), inverseDepthAt(at - dx + dy),
                      inverseDepthAt(at + dx + dy));
  float filled = 0.25 + 0.125 * dot(vec4(greaterThan(sides, vec4(0.0))), vec4(1.0)) +
                 0.0625 * dot(vec4(greaterThan(corners, vec4(0.0))), vec4(1.0));
  return clamp((filled - 0.125) / 0.75, 0.0, 1.0);
}
