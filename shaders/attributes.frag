// What a particle adds to the sums of a value at the surface: weighted value, and weight. See AttributeRaster.
layout(location = 0) uniform vec3 target;  // largest |W_x|, |W_y|; pixel slope
layout(location = 1) uniform vec3 reach;   // across the line of sight, m; least of it, pixels; 1/(along it)², 1/m²
layout(location = 2) uniform vec3 grid;    // width and height, pixels; width of a pixel in pixels of the surface
layout(binding = 0) uniform sampler2D surface;

const float kEverywhere = 1e-6;  // kValueEverywhere, in attribute_raster.h
const float kNowhere = 1e12;     // m: beyond all that a particle reaches, and its square is finite

flat in vec4 particle;
flat in float perSquareAcross;
out vec2 sums;

float depthAt(vec2 fromMiddle) {
  ivec2 size = textureSize(surface, 0);
  ivec2 place = ivec2(floor(fromMiddle * grid.z + 0.5 * vec2(size)));
  float q = texelFetch(surface, clamp(place, ivec2(0), size - 1), 0).r;
  return q > 0.0 ? 1.0 / q : kNowhere;
}

void main() {
  vec2 fromMiddle = gl_FragCoord.xy - 0.5 * grid.xy;
  vec2 e = particle.xy - particle.z * target.z * fromMiddle;
  float across = max(1.0 - perSquareAcross * dot(e, e), 0.0);
  if (across <= 0.0) discard;
  float delta = particle.z - depthAt(fromMiddle);
  float along = max(1.0 - reach.z * delta * delta, 0.0);
  float weight = across * across * (kEverywhere + along * along);
  sums = vec2(weight * particle.w, weight);
}
