// SPDX-License-Identifier: BSD-3-Clause
// Seeded roots of each chunk of 4096 pixels.
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/region_table.glsl"

layout(local_size_x = kRegionGroup) in;

layout(binding = kRegionChunksBuffer, std430) writeonly buffer Chunks { uint chunkRoots[]; };
uniform uint pixelCount;
shared uint count;

void main() {
  if (gl_LocalInvocationIndex == 0u) count = 0u;
  barrier();
  uint own = 0u;
  for (uint i = gl_LocalInvocationIndex; i < kRegionChunk; i += uint(kRegionGroup)) {
    uint pixel = gl_WorkGroupID.x * kRegionChunk + i;
    if (pixel < pixelCount && parents[pixel] == pixel && roots[pixel] != 0u) ++own;
  }
  if (own != 0u) atomicAdd(count, own);
  barrier();
  if (gl_LocalInvocationIndex == 0u) chunkRoots[gl_WorkGroupID.x] = count;
}
