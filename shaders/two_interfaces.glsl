// [Wym05] Wyman 2005, An approximate image-space approach for interactive refraction: refracted where the line of sight
// meets the liquid, and again where it leaves it. Needs surface.glsl, normal.glsl, reflections.glsl; part of
// refraction.glsl.
layout(binding = 3) uniform sampler2D backSurface;  // inverse depth of the liquid's farthest side

float backAt(vec2 slope) { return texture(backSurface, 0.5 + 0.5 * slope / liquid.slopes.zw).r; }

// Unit normal of the back, towards the eye: into the liquid.
vec3 backNormal(vec2 W, float q) {
  float pixel = frame.forwardAndPixel.w;
  float edge = 3.0 * liquid.splat.x;
  vec2 gradient = vec2(slopeOf(backAt(W - vec2(pixel, 0.0)), q, backAt(W + vec2(pixel, 0.0)), edge),
                       slopeOf(backAt(W - vec2(0.0, pixel)), q, backAt(W + vec2(0.0, pixel)), edge)) / pixel;
  return -normalize(vec3(gradient, q - dot(W, gradient)));
}

// How far the refracted ray goes inside: d̃ = (θt/θi)·d_V + (1 − θt/θi)·d_N, between the thickness along the line of sight
// and that along the normal [Wym05, Eq. 1], made better by one step of a secant search for the back (Imai et al. 2016).
float insideDistance(Entry entry, vec3 inside, float along) {
  float n = liquid.absorptionAndIndex.w;
  float cosineInside = clamp(-dot(inside, entry.normal), 0.0, 1.0);
  float ratio = entry.cosine > 0.999 ? 1.0 / n : acos(cosineInside) / acos(entry.cosine);
  float d = mix(along * entry.cosine, along, ratio);
  vec3 place = entry.place + d * inside;
  float q = backAt(place.xy / place.z);
  float before = along * entry.sight.z;  // by how much the front is nearer than the back
  float missing = (q > 0.0 ? 1.0 / q : place.z) - place.z;
  float better = d * before / max(before - missing, 0.25 * before + 1e-6);
  return clamp(better, 0.0, 2.0 * along);
}

Transmitted transmitted(Entry entry) {
  float n = liquid.absorptionAndIndex.w;
  vec3 inside = refract(entry.sight, entry.normal, 1.0 / n);
  float back = backAt(entry.slope);
  float along = back > 0.0 ? max(1.0 / back - entry.place.z, 0.0) / entry.sight.z : entry.thickness;
  float d = insideDistance(entry, inside, along);

  // Liquid on the floor, or around a body: the ray ends there, and there is no second interface.
  float height = frame.floorAndHaze.x - entry.origin.y;
  vec3 worldInside = toWorldDirection(inside);
  float ends = untilFloor(height, worldInside.y, kFar);
  bool onFloor = ends * abs(worldInside.y) <= (d * abs(worldInside.y) + 2.0 * liquid.splat.x) && ends < kFar;
  float until = untilBody(entry.place, inside, d);
  bool onBody = until < d;
  d = until;
  bool leaves = !onFloor && !onBody;

  vec3 place = entry.place + d * inside;
  // Absorption goes by the liquid that there is; there may be air between front and back.
  float path = along > 0.0 ? entry.thickness * d / along : 0.0;
#ifdef PLAIN_BEHIND
  return Transmitted(backgroundRadiance(vec3(0.0, 1.0, 0.0)), path);
#else
  float q = backAt(place.xy / place.z);
  vec3 normal = q > 0.0 ? backNormal(place.xy / place.z, q) : entry.normal;
  float cosine = clamp(-dot(inside, normal), 0.0, 1.0);
  float mirrored = leaves ? fresnelInside(cosine, n) : 0.0;
  vec3 leaving = refract(inside, normal, n);
  if (dot(leaving, leaving) < 0.5) leaving = inside;  // unused: all is mirrored
  vec3 world = entry.origin + d * worldInside;
  vec3 worldLeaving = toWorldDirection(leaving);
  float beyond = untilFloor(frame.floorAndHaze.x - world.y, worldLeaving.y, kFar);
  vec3 hit = place + leaving * untilBody(place, leaving, beyond);
  if (!leaves) hit = onBody ? place : entry.place + inside * ends;

  vec2 slope = hit.xy / hit.z;
  vec2 at = placeInPicture(slope);
  bool inPicture = hit.z > entry.place.z && all(equal(at, clamp(at, 0.0, 1.0))) && isBehind(entry.place.z, slope);
  // What the back mirrors leaves the liquid somewhere at its side, and comes from the surroundings. So does what leaves
  // it for where the picture ends: of the two, the larger share stands for both there.
  bool looksInward = inPicture || mirrored > 0.5;
  vec3 outwards = leaves ? worldLeaving : worldInside;
  vec3 around = transmittedRadiance(looksInward || leaves ? world : entry.origin,
                                    looksInward ? toWorldDirection(reflect(inside, normal)) : outwards);
  vec3 through = inPicture ? texture(scene, at).rgb : around;
  return Transmitted(mix(through, around, mirrored), path);
#endif
}
