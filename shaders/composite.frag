// The liquid over the scene: what it reflects, what it lets through, what it sends back from inside.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "surface.glsl"
#include "normal.glsl"
#include "fresnel.glsl"
#include "sky.glsl"
#include "floor.glsl"
#ifdef LAYERED
#include "layers.glsl"
#endif

layout(binding = 1) uniform sampler2D scene;
layout(binding = 2) uniform sampler2D thicknessMap;

in vec2 uv;
in vec2 slope;
out vec4 colour;

// Sky or floor in `direction` from `origin`, as a mirror sees it.
vec3 surroundings(vec3 origin, vec3 direction) {
  float height = frame.floorAndHaze.x - origin.y;
  bool meetsFloor = frame.floorAndHaze.z > 0.5 && height * direction.y > 0.0;
  vec3 sky = skyRadiance(direction);
  if (!meetsFloor) return sky;
  float distance = height / direction.y;
  vec2 point = origin.xz + distance * direction.xz;
  // A curved mirror spreads a pixel: a tenth of the distance stands for its footprint.
  return floorRadiance(point, vec2(0.1 * distance + 0.02), distance, direction);
}

#ifndef OPAQUE
// What stands behind the liquid along a ray that enters at P (view space) and leaves after `thickness` along the line
// of sight. Past the liquid the ray goes on as it came, as behind a slab, until it meets the scene, whose picture is
// looked up there.
vec3 refracted(vec3 P, vec3 sight, vec3 normal, float thickness, vec3 origin) {
  vec3 inside = refract(sight, normal, 1.0 / liquid.absorptionAndIndex.w);
  vec3 leaves = P + inside * thickness;
  vec3 worldInside = toWorldDirection(inside);
  vec3 worldSight = toWorldDirection(sight);
  float floorHeight = frame.floorAndHaze.x;
  vec3 hit = leaves + 1e3 * sight;
  if (frame.floorAndHaze.z > 0.5) {
    // The liquid stands on the floor: the ray ends where it meets it, inside or behind.
    float drop = floorHeight - origin.y;
    float untilFloor = worldInside.y * drop > 0.0 ? drop / worldInside.y : 1e9;
    float left = drop - worldInside.y * thickness;
    if (untilFloor <= thickness) {
      hit = P + inside * untilFloor;
    } else if (left * worldSight.y > 0.0) {
      hit = leaves + sight * min(left / worldSight.y, 1e3);
    }
  }
  vec2 place = 0.5 + 0.5 * hit.xy / (hit.z * frame.pictureSlopes.xy);
  // A ray turned out of the picture, or to a place before the liquid, sees what is straight behind.
  bool usable = hit.z > P.z && all(equal(place, clamp(place, 0.0, 1.0)));
  return texture(scene, usable ? place : 0.5 + 0.5 * slope / frame.pictureSlopes.xy).rgb;
}
#endif

// Share of a pixel of the liquid that the liquid covers, judged by how many of its neighbours hold any (weights 1 2 1 by
// 1 2 1): 5/6 along a straight silhouette, so that steps of the outline are soft, and never so little that a drop of a
// single pixel is lost.
float covered() {
  vec2 dx = vec2(frame.pictureSize.z, 0.0);
  vec2 dy = vec2(0.0, frame.pictureSize.w);
  vec4 sides = vec4(inverseDepthAt(uv - dx), inverseDepthAt(uv + dx), inverseDepthAt(uv - dy), inverseDepthAt(uv + dy));
  vec4 corners = vec4(inverseDepthAt(uv - dx - dy), inverseDepthAt(uv + dx - dy), inverseDepthAt(uv - dx + dy),
                      inverseDepthAt(uv + dx + dy));
  float filled = 0.25 + 0.125 * dot(vec4(greaterThan(sides, vec4(0.0))), vec4(1.0)) +
                 0.0625 * dot(vec4(greaterThan(corners, vec4(0.0))), vec4(1.0));
  return clamp((filled - 0.125) / 0.75, 0.0, 1.0);
}

void main() {
  float q = inverseDepthAt(uv);
#ifdef LAYERED
  if (!isOfLayer(slope, q)) discard;
#endif
  vec3 P = vec3(slope, 1.0) / q;
  vec3 sight = normalize(vec3(slope, 1.0));
  vec3 normal = surfaceNormal(uv, slope, q, 3.0 * liquid.splat.x);
#ifdef NORMALS
  colour = vec4(0.5 + 0.5 * normal, 1.0);
  return;
#endif
  float cosine = clamp(-dot(normal, sight), 0.0, 1.0);

  vec3 worldNormal = toWorldDirection(normal);
  vec3 worldSight = toWorldDirection(sight);
  vec3 origin = frame.eye.xyz + toWorldDirection(P);
  float reflectance = fresnel(cosine, liquid.absorptionAndIndex.w);
  vec3 mirrored = reflect(worldSight, worldNormal);
  vec3 reflection = surroundings(origin, mirrored);
  float lit = max(dot(worldNormal, frame.sun.xyz), 0.0);
  float skyLight = 0.5 + 0.5 * worldNormal.y;

#ifdef OPAQUE
  vec3 body = liquid.colourAndSpecular.rgb * (0.35 * skyLight + 0.75 * lit + 0.1);
  float coverage = covered();
#else
  float thickness = texture(thicknessMap, 0.5 + 0.5 * slope / liquid.slopes.xy).r;
  vec3 transmittance = exp(-liquid.absorptionAndIndex.rgb * thickness);
  vec3 inScatter = liquid.scatterAndGloss.rgb * (1.0 - transmittance) * (0.6 + 0.4 * skyLight + 0.5 * lit);
  vec3 body = refracted(P, sight, normal, thickness, origin) * transmittance + inScatter;
  // Liquid thins out towards its rim; the rim fades into what is behind it.
  float coverage = smoothstep(0.0, 0.3 * liquid.splat.z, thickness) * covered();
#endif

  vec3 radiance = mix(body, reflection, reflectance);
#ifdef SPECULAR
  vec3 halfway = normalize(frame.sun.xyz - worldSight);
  float gloss = liquid.scatterAndGloss.w;
  // (gloss + 8)/8π normalises Blinn's lobe.
  float highlight = (gloss + 8.0) * 0.0397887 * pow(max(dot(worldNormal, halfway), 0.0), gloss);
  float towards = fresnel(clamp(dot(halfway, -worldSight), 0.0, 1.0), liquid.absorptionAndIndex.w);
  radiance += liquid.colourAndSpecular.w * towards * highlight * lit * 3.0 * vec3(1.0, 0.94, 0.84);
#endif
  colour = vec4(radiance * coverage, coverage);
}
