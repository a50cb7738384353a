// Lamps, which shed light evenly all around, and cast no shadows.
#include "scene_lights.glsl"

// A lamp as it is seen from a point.
struct Lamp {
  vec3 towards;  // unit vector to it
  vec3 light;    // radiance of a white surface that faces it
};

int lampCount() { return int(lights.counts.x); }

Lamp lampAt(int i, vec3 point) {
  vec3 way = lights.lampPlace[i].xyz - point;
  float squared = max(dot(way, way), 1e-6);
  return Lamp(way * inversesqrt(squared), lights.lampLight[i].rgb / squared);
}

// What the lamps make a white surface send out, at `point` with this normal.
vec3 lampsOn(vec3 point, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < lampCount(); ++i) {
    Lamp lamp = lampAt(i, point);
    sum += lamp.light * max(dot(lamp.towards, normal), 0.0);
  }
  return sum;
}
