// A particle's ellipsoid (x−c)ᵀ S⁻¹ (x−c) ≤ 1 along a line of sight, exactly. Needs splat_shape.glsl. All is scaled by
// the shortest half axis, because determinants of small ellipsoids fall below the range of floats.

struct Shape {
  vec4 centre;    // c in view space and the shortest half axis, m
  vec3 diagonal;  // S_xx, S_yy, S_zz over the square of the shortest half axis
  vec3 mixed;     // S_xy, S_xz, S_yz, likewise
};

// No half axis shorter than pixels need; a ball becomes what a sphere of its size does.
Shape wideEnough(Shape shape) {
  float least = visibleRadius(shape.centre.w, shape.centre.z);
  float scale = shape.centre.w / least;
  shape.diagonal = (shape.diagonal - 1.0) * scale * scale + 1.0;
  shape.mixed *= scale * scale;
  shape.centre.w = least;
  return shape;
}

float frontDepth(Shape shape) { return shape.centre.z - shape.centre.w * sqrt(shape.diagonal.z); }

// Adjugate of S: its diagonal, and the elements xy, xz, yz.
struct Adjugate {
  vec3 diagonal;
  vec3 mixed;
  float determinant;  // of S
};

Adjugate adjugateOf(Shape shape) {
  vec3 d = shape.diagonal;
  vec3 o = shape.mixed;
  Adjugate result;
  result.diagonal = d.yxx * d.zzy - o.zyx * o.zyx;
  result.mixed = o.yxx * o.zzy - o * d.zyx;
  result.determinant = d.x * result.diagonal.x + o.x * result.mixed.x + o.y * result.mixed.y;
  return result;
}

float volumeOf(Shape shape) {
  float r = shape.centre.w;
  return 4.1887902 * r * r * r * sqrt(adjugateOf(shape).determinant);  // 4/3·π
}

// The plane x = W·z touches the ellipsoid where (c_x − W·c_z)² = (1, 0, −W)ᵀ S (1, 0, −W). For an ellipsoid wholly
// before the eye.
Bounds outlineOf(Shape shape) {
  vec3 c = shape.centre.xyz / shape.centre.w;
  vec2 along = shape.diagonal.xy;
  vec2 mixed = shape.mixed.yz;
  float room = c.z * c.z - shape.diagonal.z;
  vec2 squared = along * room + shape.diagonal.z * c.xy * c.xy + mixed * (mixed - 2.0 * c.xy * c.z);
  return Bounds((c.xy * c.z - mixed) / room, sqrt(max(squared, 0.0)) / room);
}

float quadratic(vec3 diagonal, vec3 mixed, vec3 v) {
  return dot(diagonal, v * v) + 2.0 * (mixed.x * v.x * v.y + mixed.y * v.x * v.z + mixed.z * v.y * v.z);
}

// With w = (W, 1), Q = S⁻¹: a = wᵀQw, m = wᵀQc, room = cᵀQc − 1, D = m² − a·room = a − nᵀSn/det S with n = w × c
// (Lagrange's identity), which vanishes for the line through the centre. EllipsoidRays in view_splats.h is the same.
Crossing crossingAlong(vec2 W, Shape shape) {
  Adjugate adjugate = adjugateOf(shape);
  float inverse = 1.0 / adjugate.determinant;
  vec3 diagonal = adjugate.diagonal * inverse;
  vec3 mixed = adjugate.mixed * inverse;
  float unit = 1.0 / shape.centre.w;
  vec3 w = vec3(W, 1.0) * unit;
  vec3 c = shape.centre.xyz * unit;
  vec3 n = vec3(W.y * c.z - c.y, c.x - W.x * c.z, W.x * c.y - W.y * c.x) * unit;
  vec3 Qc = diagonal * c + vec3(mixed.x * c.y + mixed.y * c.z, mixed.x * c.x + mixed.z * c.z,
                                mixed.y * c.x + mixed.z * c.y);
  Crossing crossing;
  crossing.a = quadratic(diagonal, mixed, w);
  crossing.middle = dot(w, Qc);
  crossing.squaredHalf = crossing.a - quadratic(shape.diagonal, shape.mixed, n) * inverse;
  crossing.unit = 1.0;
  crossing.room = dot(c, Qc) - crossing.unit;
  return crossing;
}
