// Needs frame_uniforms.glsl, liquid_uniforms.glsl and interface.glsl. How lights show on the liquid. A light's strength
// is the radiance of a white surface that faces it, so that π times as much falls onto that; directions are unit vectors
// away from the surface.

#ifdef LAMPS
#include "lamps.glsl"
#endif

// Share of a light that the surface mirrors to the eye: a highlight.
vec3 highlight(vec3 normal, vec3 toEye, vec3 toLight) {
  float nl = max(dot(normal, toLight), 0.0);
#ifdef PHONG
  // [CS08], section 2.4: k_s·(r·v)^s.
  float along = max(dot(reflect(-toLight, normal), toEye), 0.0);
  return vec3(nl > 0.0 ? liquid.gloss.y * pow(along, liquid.gloss.x) : 0.0);
#else
  // Microfacets [Walter et al. 2007], GGX: π·D·V·F·(n·l), with Smith's masking of both directions at once.
  vec3 halfway = normalize(toEye + toLight);
  float nv = max(dot(normal, toEye), 1e-3);
  float nh = dot(normal, halfway);
  float squared = liquid.gloss.x * liquid.gloss.x;
  float width = nh * nh * (squared - 1.0) + 1.0;
  float lobe = squared / (width * width);
  float masking = nl * sqrt(nv * nv * (1.0 - squared) + squared) + nv * sqrt(nl * nl * (1.0 - squared) + squared);
  float visible = 0.5 / max(masking, 1e-4);
  return liquid.gloss.y * lobe * visible * nl * reflectanceAt(clamp(dot(halfway, toEye), 0.0, 1.0));
#endif
}

// Share of a light that falls into the liquid where the normal is such. Light spreads below the surface, so that its
// border is soft: `spread` is how far, in cosines, it goes around the edge.
float litShare(vec3 normal, vec3 toLight, float spread) {
  return max(dot(normal, toLight) + spread, 0.0) / (1.0 + spread);
}

// Light inside the liquid below a place of that normal, as radiance of something white there.
vec3 lightBelow(vec3 point, vec3 normal, float spread) {
  vec3 light = frame.sunlight.rgb * litShare(normal, frame.sun.xyz, spread) + skylight(normal);
#ifdef LAMPS
  for (int i = 0; i < lampCount(); ++i) {
    Lamp lamp = lampAt(i, point);
    light += lamp.light * litShare(normal, lamp.towards, spread);
  }
#endif
  return light;
}

// Highlights of the sun and of lamps.
vec3 highlights(vec3 point, vec3 normal, vec3 toEye) {
  vec3 sum = frame.sunlight.rgb * highlight(normal, toEye, frame.sun.xyz);
#ifdef LAMPS
  for (int i = 0; i < lampCount(); ++i) {
    Lamp lamp = lampAt(i, point);
    sum += lamp.light * highlight(normal, toEye, lamp.towards);
  }
#endif
  return sum;
}
