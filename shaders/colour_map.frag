// A value of the particles as a colour on the liquid, shaded so gently that its form stays readable and the colours stay
// those of the legend. Drawn over the picture, with the uniforms of the surface.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "surface.glsl"
#include "normal.glsl"
#include "palette.glsl"
#ifdef LAYERED
#include "layers.glsl"
#endif

layout(binding = 1) uniform sampler2D values;

layout(location = 0) uniform vec3 range;        // least value, 1/(most − least), strength
layout(location = 1) uniform vec2 valueSlopes;  // largest |W_x|, |W_y| of the values

in vec2 uv;
out vec4 colour;

void main() {
  vec2 W = (2.0 * uv - 1.0) * frame.pictureSlopes.xy;
  vec2 at = 0.5 + 0.5 * W / vec2(frame.rightAndSlope.w, frame.downAndSlope.w);
  float q = inverseDepthAt(at);
  if (q <= 0.0) discard;
#ifdef LAYERED
  if (!isOfLayer(W, q)) discard;
#endif
  float share = clamp((texture(values, 0.5 + 0.5 * W / valueSlopes).r - range.x) * range.y, 0.0, 1.0);
#ifdef WHITENING
  // Smooth where whitening begins and ends; the colour is the only one of the palette.
  float cover = range.z * share * share * (3.0 - 2.0 * share);
#else
  float cover = range.z;
#endif
  vec3 shown = paletteColour(share);

  vec3 normal = surfaceNormal(at, W, q, 3.0 * liquid.splat.x);
  float facing = clamp(-dot(normal, normalize(vec3(W, 1.0))), 0.0, 1.0);
  // A lamp at the eye: what faces it has the legend's colour, what is turned away is a third darker.
  float shade = mix(0.66, 1.0, facing);

  // Along silhouettes half the neighbours are no liquid: there the colour goes as soft as the liquid does.
  vec2 dx = vec2(frame.pictureSize.z, 0.0);
  vec2 dy = vec2(0.0, frame.pictureSize.w);
  vec4 sides = vec4(inverseDepthAt(at - dx), inverseDepthAt(at + dx), inverseDepthAt(at - dy), inverseDepthAt(at + dy));
  cover *= 0.25 + 0.1875 * dot(vec4(greaterThan(sides, vec4(0.0))), vec4(1.0));
  colour = vec4(shade * shown * cover, cover);
}
