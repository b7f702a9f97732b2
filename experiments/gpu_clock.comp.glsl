// SPDX-License-Identifier: BSD-3-Clause
// One invocation that waits for a number of ticks of its processor's clock.
#extension GL_ARB_shader_clock : require
#include "experiments/gpu_clock_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kClockOutBuffer) buffer Out { uint elapsed; };
uniform uint ticks;

void main() {
  const uint start = clock2x32ARB().x;
  uint now = start;
  // The bound ends the loop should the counter stand still.
  for (uint i = 0u; i < ticks && now - start < ticks; ++i) now = clock2x32ARB().x;
  elapsed = now - start;
}
