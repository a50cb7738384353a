// What a particle's value reaches as a square about its centre, parallel to the picture. See AttributeRaster.
layout(location = 0) uniform vec3 target;  // largest |W_x|, |W_y|; pixel slope
layout(location = 1) uniform vec3 reach;   // across the line of sight, m; least of it, pixels; 1/(along it)², 1/m²

layout(location = 0) in vec4 centreAndValue;  // in view space, m

flat out vec4 particle;
flat out float perSquareAcross;  // 1/m²

void main() {
  particle = centreAndValue;
  float across = max(reach.x, reach.y * target.z * particle.z);
  perSquareAcross = 1.0 / (across * across);
  vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
  // A pixel more, for the rounding of the rasteriser's grid.
  vec2 place = (particle.xy + corner * across) / particle.z + corner * target.z;
  gl_Position = vec4(place / target.xy, 0.0, 1.0);
}
