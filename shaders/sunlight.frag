// Sunlight on floor and bodies where it has passed liquid: its shadow, and the light that it focuses. BODIES draws what
// falls on bodies, else the floor's part is drawn.
#include "frame_uniforms.glsl"
#ifdef BODIES
#include "scene_depth.glsl"
#endif

layout(binding = 0) uniform sampler2D background;  // alpha: the share that comes straight from the sun
layout(binding = 1) uniform sampler2D lightMap;    // factor of the sunlight behind the liquid; depth of its front, m

#ifdef BODIES
in vec2 slope;
#else
in vec2 mapPosition;
#endif
out vec4 colour;

#ifdef BODIES
// Place in the light map of what lies along the sunlight through a point.
vec2 placeInMap(vec3 point) {
  vec3 onFloor = point - frame.sun.xyz * ((point.y - frame.floorAndHaze.x) / frame.sun.y);
  vec2 way = (onFloor - frame.lightCorner.xyz).xz;
  vec2 right = frame.lightRight.xz;
  vec2 down = frame.lightDown.xz;
  return vec2(way.x * down.y - way.y * down.x, right.x * way.y - right.y * way.x) /
         (right.x * down.y - right.y * down.x);
}

vec3 factorOn(vec2 W, float q) {
  vec3 point = frame.eye.xyz + toWorldDirection(vec3(W, 1.0)) / q;
  vec2 place = placeInMap(point);
  if (any(notEqual(place, clamp(place, 0.0, 1.0)))) return vec3(1.0);
  vec4 light = texture(lightMap, place);
  // What is nearer to the sun than the liquid stays lit.
  return dot(point, -frame.sun.xyz) > light.a ? light.rgb : vec3(1.0);
}
#endif

void main() {
#ifdef BODIES
  float q = bodyDepthAt(slope);
  if (q <= 0.0) discard;
  vec3 factor = factorOn(slope, q);
#else
  vec3 factor = texture(lightMap, mapPosition).rgb;
#endif
  vec4 lit = texelFetch(background, ivec2(gl_FragCoord.xy), 0);
  float sunlight = frame.lightCorner.w * lit.a;
  colour = vec4(lit.rgb * (1.0 + sunlight * (factor - 1.0)), lit.a);
}
