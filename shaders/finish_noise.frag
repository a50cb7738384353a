// The noise, or with the flag VIOLENCE the mean violence, of the sums. See finishNoise in server/render/noise_rows.h.
layout(binding = 0) uniform sampler2D sums;

const float kLeastSquare = 0.01;  // kNoiseLeastWeight², in noise_rows.h

out float finished;

void main() {
  vec4 sum = texelFetch(sums, ivec2(gl_FragCoord.xy), 0);
#ifdef VIOLENCE
  finished = sum.z / (sum.y + kLeastSquare);
#else
  finished = sum.x / sqrt(sum.y + kLeastSquare);
#endif
}
