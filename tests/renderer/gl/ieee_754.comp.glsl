// SPDX-License-Identifier: BSD-3-Clause
// The bits of the numbers that a test gives, and of the same numbers computed here.
#include "tests/renderer/gl/ieee_754_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kIeeeNumbersBuffer) readonly buffer Numbers { float numbers[]; };
layout(std430, binding = kIeeeBitsBuffer) writeonly buffer Bits { uint bits[]; };
uniform float scale;  // 1, which the compiler does not know

void main() {
  const uint i = gl_GlobalInvocationID.x;
  bits[i] = floatBitsToUint(numbers[i] * scale);
}
