// Several liquids, one behind another: where the others are.
layout(binding = 8) uniform sampler2D otherSurfaces[7];  // inverse depth, in the order of the liquids
layout(location = 20) uniform int otherCount;
layout(location = 21) uniform int layer;
layout(location = 22) uniform int before;  // how many of the others come before this one in the order of the liquids
layout(location = 24) uniform vec2 otherSlopes[7];  // largest |W_x|, |W_y| of each

// Loops end at a constant, so that compilers unroll them: llvmpipe of Mesa 22 crashes on a program that has a cube map
// beside an array of textures whose index is not known.
const int kMostOthers = 7;

float otherDepthAt(int i, vec2 slope) { return texture(otherSurfaces[i], 0.5 + 0.5 * slope / otherSlopes[i]).r; }

// Whether just `layer` other liquids stand behind the surface of inverse depth q. Of two at one depth, the first is
// behind.
bool isOfLayer(vec2 slope, float q) {
  int behind = 0;
  for (int i = 0; i < kMostOthers; ++i) {
    if (i >= otherCount) break;
    float other = otherDepthAt(i, slope);
    if (other > 0.0 && (other < q || (other == q && i < before))) ++behind;
  }
  return behind == layer;
}

// Inverse depth of the nearest other liquid, 0 where there is none.
float nearestOther(vec2 slope) {
  float nearest = 0.0;
  for (int i = 0; i < kMostOthers; ++i) {
    if (i >= otherCount) break;
    nearest = max(nearest, otherDepthAt(i, slope));
  }
  return nearest;
}
