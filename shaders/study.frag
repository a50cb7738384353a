// One step of how the liquid is drawn, in colours that stand for values; one by flag. Drawn with the uniforms of the
// surface.
#include "frame_uniforms.glsl"
#include "liquid_uniforms.glsl"
#include "surface.glsl"
#include "normal.glsl"
#include "flow_rate.glsl"
#include "palette.glsl"
#ifdef LAYERED
#include "layers.glsl"
#endif

layout(binding = 1) uniform sampler2D values;

layout(location = 0) uniform vec3 range;        // least value, 1/(most − least), unused
layout(location = 1) uniform vec2 valueSlopes;  // largest |W_x|, |W_y| of the values

in vec2 uv;
out vec4 colour;

// Linear light of sRGB-encoded components.
vec3 linearOf(vec3 encoded) {
  return mix(encoded / 12.92, pow((encoded + 0.055) / 1.055, vec3(2.4)), greaterThan(encoded, vec3(0.04045)));
}

void main() {
  vec2 W = (2.0 * uv - 1.0) * frame.pictureSlopes.xy;
  vec2 at = 0.5 + 0.5 * W / vec2(frame.rightAndSlope.w, frame.downAndSlope.w);
  float q = inverseDepthAt(at);
  if (q <= 0.0) discard;
#ifdef LAYERED
  if (!isOfLayer(W, q)) discard;
#endif
  float edge = 3.0 * liquid.splat.x;
#if defined(DEPTH)
  vec3 shown = paletteColour((1.0 / q - range.x) * range.y);
#elif defined(VALUES)
  vec3 shown = paletteColour((texture(values, 0.5 + 0.5 * W / valueSlopes).r - range.x) * range.y);
#elif defined(LEAST)
  vec3 shown = paletteColour(0.0);
#elif defined(NORMALS)
  // x to the right, y up, z towards the eye.
  vec3 shown = linearOf(0.5 + 0.5 * surfaceNormal(at, W, q, edge) * vec3(1.0, -1.0, -1.0));
#elif defined(CURVATURE)
  // The flow moves inverse depth at ½·(q³/|N|)·[…], and the mean curvature is H = ½·(q/|N|)·[…] with the normal into the
  // liquid: a drop has −1/R. Shown is −H·d, so that a drop is green.
  float curvature = -flowRate(at, W, edge) / (q * q) * liquid.splat.z * range.y;
  vec3 shown = vec3(max(-curvature, 0.0), max(curvature, 0.0), 0.0);
  shown = linearOf(min(shown, 1.0));
#else
  // Lit from above the eye's shoulder.
  vec3 normal = surfaceNormal(at, W, q, edge);
  float lit = max(dot(normal, normalize(vec3(-0.4, -0.6, -0.7))), 0.0);
#ifdef GREY
  vec3 diffuse = vec3(0.5);
#else
  vec3 diffuse = liquid.colourAndDiffuse.rgb;
#endif
  vec3 shown = diffuse * (0.25 + 0.75 * lit);
#endif
  colour = vec4(shown, 1.0);
}
