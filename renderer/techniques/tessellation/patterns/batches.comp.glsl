// SPDX-License-Identifier: BSD-3-Clause
// Batches of patches with the same pattern, built on the GPU (SC-67). COUNT: instances of each pattern's draw. Otherwise:
// patches to their places. Their order within a batch may differ from frame to frame. One invocation a patch.
#include "renderer/techniques/tessellation/patches.glsl"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kFactorsBuffer) readonly buffer Factors { PatchFactors factors[]; };
layout(std430, binding = kPatternCountsBuffer) buffer PatternCounts { uint patternCounts[]; };
#ifndef COUNT
layout(std430, binding = kPatternOffsetsBuffer) readonly buffer PatternOffsets { uint patternOffsets[]; };
layout(std430, binding = kPatternInstancesBuffer) writeonly buffer Instances { uint instances[]; };
#endif

uniform uint patchCount;
uniform int adaptedPatterns;   // 1: one for each largest factor, otherwise one for each tuple of powers of two
uniform int levels;            // powers of two
uniform uint firstOfTriangles;  // patterns of rectangles before

uint patternOf(uint number) {
  const bool rectangle = isRectangle(shapeOf(patches[number]));
  const ivec4 f = unpackedSegments(factors[number].segments);
  const uint first = rectangle ? 0u : firstOfTriangles;
  if (adaptedPatterns == 1) {
    const int most = max(max(f.x, f.y), rectangle ? max(f.z, f.w) : f.z);
    return first + uint(findMSB(most));
  }
  uint key = 0u;
  for (int side = rectangle ? 3 : 2; side >= 0; --side) key = key * uint(levels) + uint(findMSB(f[side]));
  return first + key;
}

void main() {
  const uint number = gl_GlobalInvocationID.x;
  if (number >= patchCount || factors[number].segments == 0u) return;
  const uint pattern = patternOf(number);
  const uint at = atomicAdd(patternCounts[pattern], 1u);
#ifndef COUNT
  instances[patternOffsets[pattern] + at] = number;
#endif
}
