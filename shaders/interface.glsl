// Needs liquid_uniforms.glsl and fresnel.glsl. Share of light that the liquid's surface mirrors, from outside.
vec3 reflectanceAt(float cosine) {
#ifdef METAL
  // Conductors lose their colour towards grazing, where they mirror everything (Schlick 1994).
  float away = 1.0 - cosine;
  float squared = away * away;
  return liquid.reflectance.rgb + (1.0 - liquid.reflectance.rgb) * (squared * squared * away);
#else
  return vec3(fresnel(cosine, liquid.absorptionAndIndex.w));
#endif
}
