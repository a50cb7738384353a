// Needs frame_uniforms.glsl. A Gaussian of a given width in space, as the pixels at one inverse depth see it: so that
// distant liquid is no smoother than near.
struct Kernel {
  float stride;    // pixels from one sample to the next
  float reach;     // samples to either side
  float exponent;  // the weight n samples away is exp2(exponent·n²)
};

// `deviation` is σ in m. At most `most` samples to either side: where the kernel is wider, before the eye, they stand
// farther apart, which bounds the cost and keeps the width.
Kernel kernelAt(float q, float deviation, float most) {
  float pixels = max(deviation * q / frame.forwardAndPixel.w, 1e-3);
  // Up to 3 σ: beyond lie 0.3 % of the weight and 3 % of the variance.
  float stride = max(ceil(3.0 * pixels / most), 1.0);
  // log2(e)/2 = 0.7213475 turns exp(−n²/2σ²) into a power of 2.
  return Kernel(stride, ceil(3.0 * pixels / stride), -0.7213475 * stride * stride / (pixels * pixels));
}
