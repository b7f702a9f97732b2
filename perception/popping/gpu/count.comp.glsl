// SPDX-License-Identifier: BSD-3-Clause
// Seeded roots of each chunk of 4096 pixels.
#include "perception/popping/gpu/region_table.glsl"

layout(local_size_x = 256) in;

layout(binding = 3, std430) writeonly buffer Chunks { uint chunkRoots[]; };
uniform uint pixelCount;
const uint kChunk = 4096u;
shared uint count;

void main() {
  if (gl_LocalInvocationIndex == 0u) count = 0u;
  barrier();
  uint own = 0u;
  for (uint i = gl_LocalInvocationIndex; i < kChunk; i += 256u) {
    uint pixel = gl_WorkGroupID.x * kChunk + i;
    if (pixel < pixelCount && parents[pixel] == pixel && roots[pixel] != 0u) ++own;
  }
  if (own != 0u) atomicAdd(count, own);
  barrier();
  if (gl_LocalInvocationIndex == 0u) chunkRoots[gl_WorkGroupID.x] = count;
}
