// A soft dot of foam, as optical depth.
flat in vec4 disc;

out float opticalDepth;

void main() {
  vec2 away = gl_FragCoord.xy - disc.xy;
  // 1 − ρ²: its square ends smoothly at the rim.
  float inside = max(0.0, 1.0 - dot(away, away) / (disc.z * disc.z));
  opticalDepth = disc.w * inside * inside;
}
