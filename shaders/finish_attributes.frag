// The mean value of the sums; 0 where no particle is near.
layout(binding = 0) uniform sampler2D sums;

out float value;

void main() {
  vec2 sum = texelFetch(sums, ivec2(gl_FragCoord.xy), 0).rg;
  // The least positive normal number keeps 0/0 away.
  value = sum.x / max(sum.y, 1.1754944e-38);
}
