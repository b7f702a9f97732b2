// SPDX-License-Identifier: BSD-3-Clause
// Arithmetic for its own sake: keeps the processors' clock up.
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Out { float sink; };

void main() {
  float x = float(gl_GlobalInvocationID.x) * 1e-6;
  for (int i = 0; i < 2000; ++i) x = fma(x, 0.999, 0.0007);
  if (x < -1.0) sink = x;  // never true, which the compiler cannot know
}
