// SPDX-License-Identifier: BSD-3-Clause
// Arithmetic for its own sake: keeps the processors' clock up.
#include "experiments/gpu_clock_bindings.h"

layout(local_size_x = kBusyGroup) in;
layout(std430, binding = kClockOutBuffer) buffer Out { float sink; };

void main() {
  float x = float(gl_GlobalInvocationID.x) * 1e-6;
  for (int i = 0; i < 2000; ++i) x = fma(x, 0.999, 0.0007);
  if (x < -1.0) sink = x;  // never true, which the compiler cannot know
}
