// From linear light to what a screen shows, still linear; one operator by flag. tone_curve.cpp holds the same.
vec3 toneMap(vec3 radiance) {
#if defined(FILMIC)
  // Narkowicz 2015, a fit to the ACES reference curve.
  vec3 x = 0.6 * radiance;
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
#elif defined(REINHARD)
  return radiance / (1.0 + radiance);
#elif defined(CLIP)
  return min(radiance, 1.0);
#else
  // Linear up to the knee; above it highlights approach 1, with a continuous slope.
  const float knee = 0.8;
  vec3 excess = max(radiance - knee, 0.0) / (1.0 - knee);
  return min(radiance, knee) + (1.0 - knee) * (1.0 - exp(-excess));
#endif
}
