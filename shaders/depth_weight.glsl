// The bilateral filter's weight over differences of eye depth, at first order: z_j − z ≈ (q − q_j)·z². A plane, affine in
// q, then gives two pixels that lie opposite each other the same weight, and stays as it is.

// log2(e)/2 = 0.7213475 turns exp(−x²/2σ²) into a power of 2.
float depthExponentAt(float q, float deviation) { return -0.7213475 / (deviation * deviation * q * q * q * q); }

// Of a pixel with inverse depth `other`, given the exponent of its weight over distances; 0 where there is no liquid.
float bilateralWeight(float exponent, float depthExponent, float q, float other) {
  return other > 0.0 ? exp2(exponent + depthExponent * (other - q) * (other - q)) : 0.0;
}
