// A particle's sphere along a line of sight, exactly. Needs splat_shape.glsl.

struct Shape {
  vec4 sphere;  // centre c in view space and radius R, m
};

Shape wideEnough(Shape shape) {
  shape.sphere.w = visibleRadius(shape.sphere.w, shape.sphere.z);
  return shape;
}

float frontDepth(Shape shape) { return shape.sphere.z - shape.sphere.w; }

float volumeOf(Shape shape) { return 4.1887902 * shape.sphere.w * shape.sphere.w * shape.sphere.w; }  // 4/3·π

// W± = (x·z ± R·√(x²+z²−R²)) / (z²−R²), and likewise in y. For a sphere wholly before the eye.
Bounds outlineOf(Shape shape) {
  vec3 c = shape.sphere.xyz;
  float radius = shape.sphere.w;
  float room = c.z * c.z - radius * radius;
  return Bounds(c.xy * (c.z / room), sqrt(c.xy * c.xy + room) * (radius / room));
}

// With e = c_xy − c_z·W and k = c_x·W_y − c_y·W_x: a = 1+|W|², m = c·(W, 1), D = a·R² − |e|² − k², room = |c|² − R².
// The same terms stand in splat_rows.cpp.
Crossing crossingAlong(vec2 W, Shape shape) {
  vec4 sphere = shape.sphere;
  vec2 e = sphere.xy - sphere.z * W;
  float k = sphere.x * W.y - sphere.y * W.x;
  Crossing crossing;
  crossing.a = 1.0 + dot(W, W);
  crossing.middle = dot(sphere.xy, W) + sphere.z;
  crossing.squaredHalf = crossing.a * sphere.w * sphere.w - dot(e, e) - k * k;
  crossing.unit = sphere.w * sphere.w;
  crossing.room = dot(sphere.xyz, sphere.xyz) - crossing.unit;
  return crossing;
}
