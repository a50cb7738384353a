// Share of unpolarised light that an interface reflects, exactly. `cosine` is that of the angle in the outer medium,
// n ≥ 1 the index of the inner one.
float fresnel(float cosine, float n) {
  float inner = sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
  float s = (cosine - n * inner) / (cosine + n * inner);
  float p = (inner - n * cosine) / (inner + n * cosine);
  return 0.5 * (s * s + p * p);
}

// The same from within the inner medium: as much as along the refracted ray from outside, and all of it where there is
// none: total internal reflection.
float fresnelInside(float cosine, float n) {
  float squaredOuter = 1.0 - n * n * (1.0 - cosine * cosine);
  return squaredOuter <= 0.0 ? 1.0 : fresnel(sqrt(squaredOuter), n);
}
