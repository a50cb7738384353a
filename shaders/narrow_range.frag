// The narrow-range filter (Truong & Yuksel 2018) on inverse depth. A pixel takes part while its depth is within ±δ of
// what has taken part so far; one that is farther counts as if it were μ behind; one that is nearer does not count, nor
// does the one opposite, so that what is left stays symmetric and planes stay as they are.
// First along x and along y, some times over; then, with DISC, over a small disc, which takes away what the two axes
// leave.
#include "frame_uniforms.glsl"
#include "surface.glsl"
#include "kernel.glsl"

layout(location = 0) uniform vec2 direction;   // one pixel along the picture's x or y, in texture coordinates
layout(location = 1) uniform float deviation;  // σ, m
layout(location = 2) uniform float range;      // δ, m
layout(location = 3) uniform float beyond;     // μ, m

in vec2 uv;
out float smoothed;

// Inverse depth δ before and δ behind a surface.
float nearer(float q) { return q * range < 0.999 ? q / (1.0 - range * q) : 1e30; }
float farther(float q) { return q / (1.0 + range * q); }

// What counts along one way outwards: from `far` to `near`.
struct Range {
  float near;
  float far;
};

bool takesPart(Range r, float q) { return q >= r.far && q <= r.near; }
Range widened(Range r, float q) { return Range(max(r.near, nearer(q)), min(r.far, farther(q))); }

bool inPicture(vec2 at) { return at == clamp(at, 0.0, 1.0); }

void main() {
  float q = inverseDepthAt(uv);
  float behind = q / (1.0 + beyond * q);
  float sum = 0.0;
  float weights = 1.0;
#ifdef DISC
  Kernel kernel = kernelAt(q, deviation, 8.0);
  vec2 stride = kernel.stride * frame.pictureSize.zw;
  Range known = Range(nearer(q), farther(q));
  // Ring by ring, each with the range that those inside it left; pairs of opposite pixels.
  for (float ring = 1.0; ring <= kernel.reach; ++ring) {
    Range next = known;
    for (float k = 0.0; k < 4.0 * ring; ++k) {
      vec2 offset = k < 2.0 * ring ? vec2(ring, k - ring + 1.0) : vec2(k - 3.0 * ring, ring);
      if (dot(offset, offset) > kernel.reach * kernel.reach) continue;
      vec2 a = uv - stride * offset;
      vec2 b = uv + stride * offset;
      float before = inverseDepthAt(a);
      float after = inverseDepthAt(b);
      if (takesPart(known, before)) next = widened(next, before);
      if (takesPart(known, after)) next = widened(next, after);
      if (before > known.near || after > known.near || !inPicture(a) || !inPicture(b)) continue;
      float weight = exp2(kernel.exponent * dot(offset, offset));
      sum += weight * ((before < known.far ? behind : before) - q + (after < known.far ? behind : after) - q);
      weights += 2.0 * weight;
    }
    known = next;
  }
#else
  Kernel kernel = kernelAt(q, deviation, 48.0);
  vec2 stride = kernel.stride * direction;
  Range rangeBefore = Range(nearer(q), farther(q));
  Range rangeAfter = rangeBefore;
  for (float n = 1.0; n <= kernel.reach; ++n) {
    vec2 a = uv - n * stride;
    vec2 b = uv + n * stride;
    // Past the picture's border nothing is known: the pair does not count.
    if (!inPicture(a) || !inPicture(b)) break;
    float before = inverseDepthAt(a);
    float after = inverseDepthAt(b);
    bool counts = before <= rangeBefore.near && after <= rangeAfter.near;
    float weight = counts ? exp2(kernel.exponent * n * n) : 0.0;
    sum += weight * ((before < rangeBefore.far ? behind : before) - q + (after < rangeAfter.far ? behind : after) - q);
    weights += 2.0 * weight;
    if (takesPart(rangeBefore, before)) rangeBefore = widened(rangeBefore, before);
    if (takesPart(rangeAfter, after)) rangeAfter = widened(rangeAfter, after);
  }
#endif
  smoothed = q + sum / weights;
}
