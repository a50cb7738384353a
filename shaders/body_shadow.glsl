// Needs scene_lights.glsl. Shade that bodies cast.
layout(binding = 15) uniform sampler2DShadow bodyShadow;

// Share of the sun that is seen from a point of a surface with this normal.
float sunlightPastBodies(vec3 point, vec3 normal) {
  if (lights.counts.w < 0.5) return 1.0;
  // Off the surface by the filter's reach: what keeps a surface from shading itself.
  vec4 at = vec4(point + 2.0 * lights.counts.z * normal, 1.0);
  vec3 place = vec3(dot(lights.toShadowU, at), dot(lights.toShadowV, at), dot(lights.toShadowDepth, at));
  if (any(notEqual(place.xy, clamp(place.xy, 0.0, 1.0)))) return 1.0;
  return texture(bodyShadow, vec3(place.xy, clamp(place.z, 0.0, 1.0)));
}

// Share of the sky that bodies leave to the floor at `point`: soft contact. Each hides (r/d)²·cos of it, as a ball does,
// and nothing from five radii on, see shadedFloor() in server/render/body_scene.h.
float skyPastBodies(vec3 point) {
  float open = 1.0;
  for (int i = 0; i < int(lights.counts.y); ++i) {
    vec3 way = lights.contact[i].xyz - point;
    float squared = dot(way, way);
    float radius = lights.contact[i].w;
    float rise = clamp(abs(way.y) * inversesqrt(squared), 0.0, 1.0);
    float near = max(1.0 - squared / (25.0 * radius * radius), 0.0);
    open *= 1.0 - 0.8 * min(radius * radius / squared, 1.0) * rise * near * near;
  }
  return open;
}
