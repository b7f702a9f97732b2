// SPDX-License-Identifier: BSD-3-Clause
// All words of a part of a buffer become the same.
#include "renderer/gl/fill_bindings.h"

layout(local_size_x = kFillGroup) in;
layout(std430, binding = kFilledBuffer) writeonly buffer Words { uint words[]; };
uniform uint wordCount, value;

void main() {
  for (uint i = 0u; i < uint(kFillWords); ++i) {
    const uint at = uint(kFillGroup) * (uint(kFillWords) * gl_WorkGroupID.x + i) + gl_LocalInvocationIndex;
    if (at < wordCount) words[at] = value;
  }
}
