// A drop of spray: a small round cloud of droplets, which scatter the light of sky and sun, dense in its middle.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "splat_shape.glsl"
#include "surface.glsl"
#include "environment.glsl"
#ifdef BODIES
#include "scene_depth.glsl"
#endif
#ifdef LAYERED
#include "layers.glsl"
#endif

flat in Shape shape;
out vec4 colour;

void main() {
  vec2 W = slopeAt(gl_FragCoord.xy);
  Crossing crossing = crossingAlong(W, shape);
#ifdef BODIES
  if (bodyDepthAt(W) * crossing.middle > crossing.a) discard;
#endif
  float radius = shape.sphere.w;
  // 1 − ρ², with ρ from 0 in the middle to 1 at the rim; its square, and the slope of that, end smoothly there.
  float inside = clamp(crossing.squaredHalf / (crossing.a * radius * radius), 0.0, 1.0);
  // A drop that had to be widened to a pixel is as much thinner.
  float widening = liquid.splat.y / radius;
  float coverage = 0.85 * inside * inside * widening * widening;

#if defined(LIQUID) || defined(LAYERED)
  // Sinks into the liquid over its own radius, without an edge.
  float q = 0.0;
#ifdef LIQUID
  q = inverseDepthAt(0.5 + 0.5 * W / liquid.slopes.zw);
#endif
#ifdef LAYERED
  q = max(q, nearestOther(W));
#endif
  float front = (crossing.middle - sqrt(max(crossing.squaredHalf, 0.0))) / crossing.a;
  coverage *= q > 0.0 ? clamp((1.0 / q - front) / radius, 0.0, 1.0) : 1.0;
#endif

  // The normal of the sphere where the line of sight enters it.
  vec3 entry = vec3(W, 1.0) * (crossing.middle - sqrt(max(crossing.squaredHalf, 0.0))) / crossing.a;
  vec3 normal = toWorldDirection((entry - shape.sphere.xyz) / radius);
  // Light is scattered all through a cloud; what faces the sun is little brighter than what does not.
  float lit = 0.7 + 0.3 * dot(normal, frame.sun.xyz);
  vec3 radiance = 0.9 * ambientAbove() + 0.55 * lit * frame.sunlight.rgb;
  radiance = liquid.sprayTint.rgb * radiance + liquid.sprayTint.w * liquid.emission.rgb;
  colour = vec4(radiance * coverage, coverage);
}
