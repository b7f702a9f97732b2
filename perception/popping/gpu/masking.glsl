// SPDX-License-Identifier: BSD-3-Clause
// Transducers of contrast, as perception/vision/masking.h; |c| finite. Constants come as defines.

// (1 + x^b)^(1/b), x >= 0, where x^b may overflow.
float softMaximum(float x, float b) {
  return x > 1.0 ? x * pow(1.0 + pow(x, -b), 1.0 / b) : pow(1.0 + pow(x, b), 1.0 / b);
}

float transducer(float c) {
  float x = abs(c);
  if (x == 0.0) return 0.0;
#if defined(MASKING_NONE)
  return c;
#elif defined(MASKING_CUBIC)
  // Elevation |c|^0.3 with b = 10: one power of ten less.
  return sign(c) * (x <= 1.0 ? x * pow(1.0 + x * x * x, -0.1)
                             : pow(x, 0.7) * pow(1.0 + 1.0 / (x * x * x), -0.1));
#elif defined(MASKING_ELEVATION)
  return c / softMaximum(MASKING_K * pow(x, MASKING_S), MASKING_B);
#elif defined(MASKING_LUBIN)
  return sign(c) * (x > 1.0 ? 2.0 * pow(x, MASKING_W) / (1.0 + pow(x, MASKING_W - MASKING_N))
                            : 2.0 * pow(x, MASKING_N) / (pow(x, MASKING_N - MASKING_W) + 1.0));
#else
  return sign(c) * pow(x, MASKING_ALPHA);
#endif
}
