// A particle as it comes from SplatBuffers. Needs splat_shape.glsl.
#ifdef ELLIPSOID
layout(location = 0) in vec4 centreAndAxis;  // in view space; the shortest half axis, m
layout(location = 1) in vec3 diagonal;       // S_xx, S_yy, S_zz, m²
layout(location = 2) in vec3 mixed;          // S_xy, S_xz, S_yz, m²

Shape readShape() {
  float scale = 1.0 / (centreAndAxis.w * centreAndAxis.w);
  return Shape(centreAndAxis, diagonal * scale, mixed * scale);
}
#else
layout(location = 0) in vec4 sphere;  // centre in view space and radius, m

Shape readShape() { return Shape(sphere); }
#endif
