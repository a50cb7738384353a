// What a particle adds to the sums of the noise: weighted noise, the weight's square, and that of violence. See
// addNoiseRow in server/render/noise_rows.h.
#include "frame_uniforms.glsl"
#include "surface.glsl"
#include "gradient_noise.glsl"

layout(location = 0) uniform float perFallOff;  // 1/m

flat in vec4 disc;
flat in vec4 toLattice;
flat in uint seed;
flat in float height;
flat in float violence;
out vec4 sums;

void main() {
  float q = texelFetch(surface, ivec2(gl_FragCoord.xy), 0).r;
  vec2 W = (gl_FragCoord.xy - 0.5 * frame.pictureSize.xy) * frame.forwardAndPixel.w;
  vec2 l = (W * disc.z - disc.xy) / disc.w;
  float kernel = max(1.0 - dot(l, l), 0.0);
  if (q <= 0.0 || kernel <= 0.0) discard;
  float below = (disc.z - 1.0 / q) * perFallOff;
  float fall = max(1.0 - 0.25 * below * below, 0.0);
  fall *= fall;
  fall *= fall;
  float weight = kernel * kernel * fall;
  vec2 place = toLattice.zw + vec2(toLattice.x * l.x - toLattice.y * l.y, toLattice.y * l.x + toLattice.x * l.y);
  sums = vec4(weight * height * gradientNoise(place, seed), weight * weight, weight * weight * violence, 0.0);
}
