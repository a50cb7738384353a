// Needs frame_uniforms.glsl, liquid_uniforms.glsl and scene_lights.glsl. Bodies that a ray meets, followed to within what
// a picture of them shows: with CUBE_MAP that around the liquid's middle, whose distances tell where on the ray a body is [Szirmay-Kalos
// et al. 2005, Approximate ray-tracing on the GPU with distance impostors]; without the eye's own, for
// which it needs picture_place.glsl and scene_depth.glsl.

const float kNoBody = 1e9;  // m

#ifdef CUBE_MAP
layout(binding = 25) uniform samplerCube bodyCube;          // light, and 1; 0 where there is no body
layout(binding = 26) uniform samplerCube bodyDistanceCube;  // 1/distance, 1/m, and 1

// How far a place is behind the body that is seen in its direction, m; negative before it. Between a body and none, the
// picture's values are those of the body times its share.
float behindBody(vec3 place) {
  vec3 way = place - liquid.cubeAndReach.xyz;
  vec2 seen = textureLod(bodyDistanceCube, way, 0.0).xy;
  return seen.y > 0.5 ? length(way) - seen.y / seen.x : -kNoBody;
}

vec3 bodyRadiance(vec3 place) {
  vec4 seen = textureLod(bodyCube, place - liquid.cubeAndReach.xyz, 0.0);
  return seen.rgb / max(seen.a, 0.25);
}
#else
float behindBody(vec3 place) {
  vec3 P = toView(place);
  vec2 W = P.xy / P.z;
  if (P.z <= 0.0 || any(greaterThan(abs(W), frame.pictureSlopes.xy))) return -kNoBody;
  float q = bodyDepthAt(W);
  return q > 0.0 ? P.z - 1.0 / q : -kNoBody;
}

vec3 bodyRadiance(vec3 place) {
  vec3 P = toView(place);
  return texture(scene, placeInPicture(P.xy / P.z)).rgb;
}
#endif

// Where a ray of unit direction comes into the first and out of the last of the balls around bodies, m; the first beyond
// the second where it meets none.
vec2 wayThroughBodies(vec3 origin, vec3 direction) {
  vec2 way = vec2(1e9, -1e9);
  for (int i = 0; i < 8 && lights.body[i].w > 0.0; ++i) {
    vec3 towards = lights.body[i].xyz - origin;
    float along = dot(towards, direction);
    float squared = lights.body[i].w * lights.body[i].w + along * along - dot(towards, towards);
    float halfWay = sqrt(max(squared, 0.0));
    bool meets = squared > 0.0 && along + halfWay > 0.0;
    way = meets ? vec2(min(way.x, max(along - halfWay, 0.0)), max(way.y, along + halfWay)) : way;
  }
  return way;
}

// Light of the body that a ray meets, and 1; or 0 where it meets none. How far bodies reach behind what is seen of them
// is not known: a ray that was before a body and now is behind it has met it, up to `reach`; one that comes from beside
// it or from behind it has met it only if it is no farther behind than it came in one step.
vec4 bodySeen(vec3 origin, vec3 direction) {
  vec2 way = wayThroughBodies(origin, direction);
  if (way.x >= way.y) return vec4(0.0);
  float step = (way.y - way.x) / liquid.mirrorSteps.x;
  // Onwards until the ray has met it, then by halves between there and the place before: one loop, for software GL runs
  // every loop's body at least once.
  float before = way.x;
  float at = way.x;
  float met = -1.0;
  bool wasBefore = false;
  int halves = 4;
  while (halves > 0 && at <= way.y + 0.5 * step) {
    float behind = behindBody(origin + at * direction);
    bool onwards = met < 0.0;
    bool meets = behind >= 0.0 && (!onwards || behind < (wasBefore ? liquid.cubeAndReach.w : step));
    wasBefore = behind < 0.0 && behind > -kNoBody;
    met = meets ? at : met;
    before = meets ? before : at;
    halves -= onwards ? 0 : 1;
    at = met < 0.0 ? at + step : 0.5 * (before + met);
  }
  return met < 0.0 ? vec4(0.0) : vec4(bodyRadiance(origin + met * direction), 1.0);
}
