// One face of a thin wall of glass: what it mirrors, and what it lets through. BEFORE draws what is before the liquid,
// or, where there is none, faces the eye; without it the rest is drawn. RIM draws its edges.
#include "frame_uniforms.glsl"
#include "fresnel.glsl"
#include "environment.glsl"
#include "floor.glsl"
#include "scene_depth.glsl"
#include "liquid_front.glsl"

in vec3 point;
in vec4 tintAndIndex;
#ifdef RIM
in float across;
flat in float pixels;
#else
in vec3 normal;
#endif
layout(location = 0, index = 0) out vec4 light;
layout(location = 0, index = 1) out vec4 passed;

vec3 mirrored(vec3 direction) {
  float height = frame.floorAndHaze.x - point.y;
  if (frame.floorAndHaze.z < 0.5 || height * direction.y <= 0.0) return environmentRadiance(direction);
  float distance = height / direction.y;
  // A pane is flat: the mirrored floor is as fine as a floor as far away.
  vec2 footprint = vec2((distance + length(point - frame.eye.xyz)) * frame.forwardAndPixel.w / max(abs(direction.y), 0.05));
  return floorRadiance(point.xz + distance * direction.xz, footprint, distance, environmentRadiance(levelled(direction)));
}

void main() {
  vec3 P = toView(point);
  vec2 W = P.xy / P.z;
  float q = 1.0 / P.z;
#ifdef BODIES
  if (bodyDepthAt(W) > q) discard;
#endif
  vec3 sight = normalize(point - frame.eye.xyz);
  float front = liquidFront(W);
#ifdef RIM
  bool isBefore = q > front;
#else
  vec3 n = normalize(normal);
  bool facesEye = dot(n, sight) < 0.0;
  if (!facesEye) n = -n;
  bool isBefore = front > 0.0 ? q > front : facesEye;
#endif
#ifdef BEFORE
  if (!isBefore) discard;
#else
  if (isBefore) discard;
#endif

#ifdef RIM
  // Light from all around is led through the pane to its polished edge: bright, and as deep in colour as the way is long.
  float cover = clamp(pixels + 0.5 - abs(across), 0.0, 1.0) * min(2.0 * pixels, 1.0);
  vec3 sky = ambientAbove();
  // Led from every side, it is a mixture, and whiter than the sky.
  vec3 led = mix(sky, vec3(dot(sky, vec3(0.2126, 0.7152, 0.0722))), 0.7) * pow(tintAndIndex.rgb, vec3(3.0));
  light = vec4(1.1 * cover * led, 0.0);
  passed = vec4(vec3(1.0 - 0.7 * cover), 1.0);
#else
  float cosine = clamp(-dot(n, sight), 1e-3, 1.0);
  float index = tintAndIndex.w;
  float once = fresnel(cosine, index);
  float inside = sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
  vec3 through = pow(tintAndIndex.rgb, vec3(1.0 / inside));
  // A plate's two faces mirror again and again: R + T²R/(1 − R²) in all, here with the plate's colour on the way.
  vec3 again = (1.0 - once) * (1.0 - once) / (1.0 - once * once * through * through);
  vec3 reflected = once * (1.0 + again * through * through);
  light = vec4(reflected * mirrored(reflect(sight, n)), 0.0);
  passed = vec4(again * through, 1.0);
#endif
}
