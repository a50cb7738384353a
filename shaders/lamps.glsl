// Needs scene_lights.glsl. What the lamps make a white surface send out, at `point` with this normal.
vec3 lampsOn(vec3 point, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < int(lights.counts.x); ++i) {
    vec3 way = lights.lampPlace[i].xyz - point;
    float squared = max(dot(way, way), 1e-6);
    sum += lights.lampLight[i].rgb * (max(dot(way, normal), 0.0) * inversesqrt(squared) / squared);
  }
  return sum;
}
