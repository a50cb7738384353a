// The plane through the neighbouring pixels of the same surface by weighted least squares, met by the line of sight
// (after Imai, Kanamori & Mitani 2016). A plane is affine in inverse depth, so that the fit is linear,
//   q ≈ c_0 + c_1·x + c_2·y  (x, y: samples from the pixel),
// its value on the pixel's own line of sight is c_0, and planes stay as they are whichever pixels take part.
#include "frame_uniforms.glsl"
#include "surface.glsl"
#include "kernel.glsl"

layout(location = 0) uniform float deviation;  // σ of the weights, m
layout(location = 1) uniform float range;      // difference of depth from which on a pixel is of another surface, m

in vec2 uv;
out float smoothed;

float squared(float x) { return x * x; }

void main() {
  float q = inverseDepthAt(uv);
  // 12 samples to either side are at least two to a σ, mostly four, and 450 in all.
  Kernel kernel = kernelAt(q, deviation, 12.0);
  vec2 stride = kernel.stride * frame.pictureSize.zw;
  // Moments of x, y and of p, the difference of q from the pixel's.
  float s = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, p = 0.0, xp = 0.0, yp = 0.0;
  float least = q;
  float most = q;
  for (float j = -kernel.reach; j <= kernel.reach; ++j) {
    float width = floor(sqrt(kernel.reach * kernel.reach - j * j));
    for (float i = -width; i <= width; ++i) {
      float other = inverseDepthAt(uv + stride * vec2(i, j));
      // A biweight of the difference of depth, (1/q_j − 1/q)/range: pixels come and go without a jump.
      float inRange = 1.0 - squared((other - q) / max(range * q * other, 1e-30));
      if (inRange <= 0.0) continue;
      float weight = exp2(kernel.exponent * (i * i + j * j)) * inRange * inRange;
      float difference = weight * (other - q);
      least = min(least, other);
      most = max(most, other);
      s += weight;
      x += weight * i;
      y += weight * j;
      xx += weight * i * i;
      xy += weight * i * j;
      yy += weight * j * j;
      p += difference;
      xp += difference * i;
      yp += difference * j;
    }
  }
  // Cramer's rule for c_0 with the moments about the middle of the samples.
  float mx = x / s;
  float my = y / s;
  xx -= x * mx;
  xy -= x * my;
  yy -= y * my;
  float determinant = xx * yy - xy * xy;
  float mean = p / s;
  xp -= p * mx;
  yp -= p * my;
  float slopes = mx * (yy * xp - xy * yp) + my * (xx * yp - xy * xp);
  // Pixels in one line tell nothing of the slope across, and a single one nothing at all: they stay. A fit to few pixels
  // may pass far from this one: it is held to the depths that took part.
  smoothed = determinant > 1e-4 * xx * yy ? clamp(q + mean - slopes / determinant, least, most) : q;
}
