// Needs surface.glsl and normal.glsl. The noise that goes with the particles, on a shaded surface.
layout(binding = 16) uniform sampler2D noiseMap;  // height, m
layout(location = 40) uniform vec3 whitening;  // how white; share of the noise of calm liquid; 1/height of violent noise
#ifdef WHITENING
layout(binding = 17) uniform sampler2D violenceMap;
#endif

// Slope of the noise from one pixel to the next, m per pixel, on the surface at hand.
float noiseSlope(float q, vec2 at, vec2 step, float edge) {
  float here = texture(noiseMap, at).r;
  bool before = onOneSurface(q, inverseDepthAt(at - step), edge);
  bool after = onOneSurface(q, inverseDepthAt(at + step), edge);
  float backward = here - texture(noiseMap, at - step).r;
  float forward = texture(noiseMap, at + step).r - here;
  return ((before ? backward : 0.0) + (after ? forward : 0.0)) / (before && after ? 2.0 : 1.0);
}

// The normal of the surface with the noise upon it; `normal` is towards the eye, and so is the outcome.
vec3 roughened(vec3 normal, vec2 at, vec2 W, float q) {
  float edge = 3.0 * liquid.splat.x;
  float perMetre = q / frame.forwardAndPixel.w;  // pixels in a metre there
  vec3 gradient = vec3(noiseSlope(q, at, vec2(frame.pictureSize.z, 0.0), edge),
                       noiseSlope(q, at, vec2(0.0, frame.pictureSize.w), edge), 0.0) * perMetre;
  if (dot(gradient, gradient) < 1e-12) return normal;  // too little to see: not to change a bit
  vec3 sight = normalize(vec3(W, 1.0));
  // Towards silhouettes, where a pixel spans ever more of the surface, the noise fades.
  float facing = -dot(normal, sight);
  gradient *= smoothstep(0.0, 0.5, facing);
  vec3 rough = normalize(normal - gradient + normal * dot(normal, gradient));
  // A wave's far side is not seen: the normal stays towards the eye, or as far from it as it was.
  float away = max(dot(rough, sight) + min(facing, 0.05), 0.0);
  return normalize(rough - away * sight);
}

// Share of a melt's glow that comes through its crust: plates, each where the noise is high or low, and cracks between
// them, where it goes through 0.
float throughCrust(vec2 at) {
  float plate = smoothstep(0.05, 0.6, abs(texture(noiseMap, at).r) * whitening.z);
  return exp(-5.0 * plate);
}

#ifdef WHITENING
// Foam where violent liquid's noise is large: patches of the noise's own shape, that grow together with the violence.
vec3 whitened(vec3 radiance, vec2 at, vec3 worldNormal) {
  float violence = texture(violenceMap, at).r;
  float strength = mix(whitening.y, 1.0, violence);
  float size = abs(texture(noiseMap, at).r) * whitening.z / max(strength, 1e-3);
  float least = mix(1.8, 0.1, violence);
  float white = whitening.x * smoothstep(least, least + 1.0, size) * smoothstep(0.05, 0.4, violence);
  // Bubbles scatter the light of sun and sky, and of whatever side it comes much is seen.
  float lit = 0.3 + 0.7 * max(dot(worldNormal, frame.sun.xyz), 0.0);
  float skyLight = 0.5 + 0.5 * worldNormal.y;
  vec3 foam = 0.9 * ambientAbove() * skyLight + 0.75 * lit * frame.sunlight.rgb;
  return mix(radiance, foam, white);
}
#endif
