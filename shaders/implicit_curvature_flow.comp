// Mean curvature flow on inverse depth in long implicit steps, line by line; implicit_curvature_flow.h describes it, and
// is the same on the CPU. One variant per stage:
//   RANGE       least and largest inverse depth of the liquid, one line a thread;
//   CLOSE_GAPS  narrow gaps along a line, which may be a diagonal, one line a thread;
//   LINK        each pixel's links to its neighbours along the axis, and its right-hand side, one pixel a thread;
//   SOLVE       elimination and substitution along a line, one line a thread.
#include "frame_uniforms.glsl"

#ifdef LINK
layout(local_size_x = 16, local_size_y = 16) in;
#else
layout(local_size_x = 32) in;
#endif

layout(binding = 0, r32f) uniform image2D surface;
layout(binding = 1, r32f) uniform readonly image2D orientedSurface;
layout(binding = 2, r32f) uniform image2D beforeLinks;
layout(binding = 3, r32f) uniform image2D afterLinks;
layout(binding = 4, r32f) uniform image2D rightSides;

// Positive floats keep their order when they are read as integers.
layout(std430, binding = 1) buffer DepthRange {
  uint least;
  uint largest;
} range;

layout(location = 0) uniform ivec2 along;      // (1, 0): lines are rows; (0, 1): columns; to close gaps also (1, 1) and (-1, 1)
layout(location = 1) uniform float edge;       // step of depth that counts as a silhouette, m
layout(location = 2) uniform float timeStep;   // m²
layout(location = 3) uniform float slopeReach; // over which the slope at an end is taken, m
layout(location = 4) uniform float widestGap;  // m
layout(location = 5) uniform int oriented;     // 0: A = ½q²·I, as of a surface that faces the eye

// 0 outside the picture, as imageLoad has it.
float at(ivec2 p) { return imageLoad(surface, p).r; }

bool linked(float q, float neighbour) { return abs(neighbour - q) <= edge * q * neighbour; }

ivec2 sizeAlong(ivec2 size) { return along.x == 1 ? size : size.yx; }

// A length in pixels at inverse depth q, as in the C++.
int pixels(float length, float q) { return int(min(length * q / frame.forwardAndPixel.w, 128.0)); }

#ifdef RANGE
void main() {
  ivec2 size = imageSize(surface);
  int line = int(gl_GlobalInvocationID.x);
  if (line >= size.y) return;
  float low = 3e38;
  float high = 0.0;
  for (int i = 0; i < size.x; ++i) {
    float q = at(ivec2(i, line));
    low = q > 0.0 ? min(low, q) : low;
    high = max(high, q);
  }
  atomicMin(range.least, floatBitsToUint(low));
  atomicMax(range.largest, floatBitsToUint(high));
}
#endif

#ifdef CLOSE_GAPS
// `along` may be diagonal, downwards; a line then starts at the top, or at the side that it comes from.
void main() {
  ivec2 size = imageSize(surface);
  int line = int(gl_GlobalInvocationID.x);
  ivec2 start;
  if (along.y == 0) {
    start = ivec2(0, line);
  } else {
    start = line < size.x ? ivec2(line, 0) : ivec2(along.x > 0 ? 0 : size.x - 1, line - size.x + 1);
    if (along.x == 0 && line >= size.x) return;
  }
  float length = along.x != 0 && along.y != 0 ? widestGap * 0.70710678 : widestGap;
  for (ivec2 p = start; all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, size)); p += along) {
    float q = at(p);
    float behind = at(p + along);
    if (q - behind <= edge * q * behind) continue;
    int widest = pixels(length, q);
    for (int n = 1; n <= widest + 1; ++n) {
      float next = at(p + along * n);
      if (linked(q, next)) {
        for (int k = 1; k < n; ++k) imageStore(surface, p + along * k, vec4(q + (next - q) / float(n) * float(k)));
        break;
      }
      if (next > q) break;
    }
  }
}
#endif

#ifdef LINK
// How the end of a line moves; see linkEnd in flow_rows.h. x: link to the neighbour inside, y: right-hand side.
vec2 endLink(ivec2 p, ivec2 inwards, float q, float mobility) {
  int most = max(pixels(slopeReach, q), 4);
  float first = at(p + inwards);
  float last = first;
  int reach = 0;
  while (reach < most) {
    float next = at(p + inwards * (reach + 2));
    if (!linked(last, next)) break;
    last = next;
    ++reach;
  }
  if (reach < 2) return vec2(0.0);
  float link = min(mobility, 1.0);
  return vec2(link, link * (first - q - (last - first) / float(reach)));
}

void main() {
  ivec2 size = imageSize(surface);
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, size))) return;
  float q = at(p);
  float before = 0.0;
  float after = 0.0;
  float rightSide = 0.0;
  if (q > 0.0) {
    const ivec2 dx = ivec2(1, 0);
    const ivec2 dy = ivec2(0, 1);
    vec4 sides = vec4(at(p - dx), at(p + dx), at(p - dy), at(p + dy));
    vec4 corners = vec4(at(p - dx - dy), at(p + dx - dy), at(p - dx + dy), at(p + dx + dy));
    vec4 has = vec4(lessThanEqual(abs(sides - q), edge * q * sides));
    float pixel = frame.forwardAndPixel.w;
    float scale = 0.5 * timeStep / (pixel * pixel);
    vec3 A = vec3(scale * q * q, scale * q * q, 0.0);  // A^xx, A^yy, A^xy times Δt/C²
    if (oriented != 0) {
      float o = imageLoad(orientedSurface, p).r;
      float stepW = has.x * (o - imageLoad(orientedSurface, p - dx).r);
      float stepE = has.y * (imageLoad(orientedSurface, p + dx).r - o);
      float stepN = has.z * (o - imageLoad(orientedSurface, p - dy).r);
      float stepS = has.w * (imageLoad(orientedSurface, p + dy).r - o);
      vec2 gradient = 0.5 / pixel * vec2(stepE + (1.0 - has.y) * stepW + stepW + (1.0 - has.x) * stepE,
                                         stepS + (1.0 - has.w) * stepN + stepN + (1.0 - has.z) * stepS);
      vec2 W = (vec2(p) + 0.5 - 0.5 * vec2(size)) * pixel;
      float n3 = o - dot(W, gradient);
      float inverse = 1.0 / max(dot(gradient, gradient) + n3 * n3, 1e-30);
      float mobility = scale * o * o * o * sqrt(inverse);
      vec2 b = gradient - W * n3;
      A = mobility * (vec3(1.0 + W * W, W.x * W.y) - vec3(b * b, b.x * b.y) * inverse);
    }
    bool rows = along.x == 1;
    bvec2 there = rows ? bvec2(has.xy) : bvec2(has.zw);
    float own = rows ? A.x : A.y;
    if (all(there)) {
      float second = rows ? sides.y - 2.0 * q + sides.x : sides.w - 2.0 * q + sides.z;
      before = after = own;
      rightSide = own * second;
      if (rows && oriented != 0) {
        bool inner = has.z * has.w > 0.0 && all(lessThanEqual(abs(corners - q), edge * q * corners));
        float limit = 0.9 * min(A.x, A.y);
        float mixed = corners.w - corners.z - corners.y + corners.x;
        if (inner) rightSide += 0.5 * clamp(A.z, -limit, limit) * mixed;
      }
    } else if (there.y) {
      vec2 link = endLink(p, along, q, own);
      after = link.x;
      rightSide = link.y;
    } else if (there.x) {
      vec2 link = endLink(p, -along, q, own);
      before = link.x;
      rightSide = link.y;
    }
  }
  imageStore(beforeLinks, p, vec4(before));
  imageStore(afterLinks, p, vec4(after));
  imageStore(rightSides, p, vec4(rightSide));
}
#endif

#ifdef SOLVE
void main() {
  ivec2 size = sizeAlong(imageSize(surface));
  int line = int(gl_GlobalInvocationID.x);
  if (line >= size.y) return;
  ivec2 start = (ivec2(1) - along) * line;
  float eliminated = 0.0;
  float known = 0.0;
  for (int i = 0; i < size.x; ++i) {
    ivec2 p = start + along * i;
    float before = imageLoad(beforeLinks, p).r;
    float after = imageLoad(afterLinks, p).r;
    float divisor = 1.0 / (1.0 + after + before * (1.0 - eliminated));
    known = (imageLoad(rightSides, p).r + before * known) * divisor;
    eliminated = after * divisor;
    imageStore(afterLinks, p, vec4(eliminated));
    imageStore(rightSides, p, vec4(known));
  }
  float least = uintBitsToFloat(range.least);
  float largest = uintBitsToFloat(range.largest);
  float change = 0.0;
  for (int i = size.x - 1; i >= 0; --i) {
    ivec2 p = start + along * i;
    change = imageLoad(rightSides, p).r + imageLoad(afterLinks, p).r * change;
    float q = at(p);
    float moved = clamp(q + change, least, largest);
    imageStore(surface, p, vec4(clamp(moved, 0.5 * q, 2.0 * q)));
  }
}
#endif
