// Linear light up to the knee; above it highlights approach 1, with a continuous slope.
vec3 toneMap(vec3 radiance) {
  const float knee = 0.8;
  vec3 excess = max(radiance - knee, 0.0) / (1.0 - knee);
  return min(radiance, knee) + (1.0 - knee) * (1.0 - exp(-excess));
}
