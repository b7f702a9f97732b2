// SPDX-License-Identifier: BSD-3-Clause
// How many instances each pattern's draw has, and from where. One invocation a pattern.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kPatternCountsBuffer) readonly buffer PatternCounts { uint patternCounts[]; };
layout(std430, binding = kPatternOffsetsBuffer) readonly buffer PatternOffsets { uint patternOffsets[]; };
layout(std430, binding = kPatternCommandsBuffer) buffer Commands { PatternCommand commands[]; };
uniform uint patternCount;

void main() {
  const uint pattern = gl_GlobalInvocationID.x;
  if (pattern >= patternCount) return;
  commands[pattern].instances = patternCounts[pattern];
  commands[pattern].firstInstance = patternOffsets[pattern];
}
