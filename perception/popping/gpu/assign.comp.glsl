// SPDX-License-Identifier: BSD-3-Clause
// Numbers the seeded roots in the order of their pixels and makes their records.
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/region_table.glsl"

layout(local_size_x = kRegionGroup) in;

layout(binding = kRegionChunksBuffer, std430) readonly buffer Chunks { uint chunkRoots[]; };
uniform uint pixelCount;
const uint kWords = kRegionChunk / 32u;
shared uint before;         // roots of the chunks before this one
shared uint bits[kWords];   // which pixels of the chunk are seeded roots

void main() {
  uint own = gl_LocalInvocationIndex, chunk = gl_WorkGroupID.x;
  if (own == 0u) before = 0u;
  if (own < kWords) bits[own] = 0u;
  barrier();
  bool isLast = chunk + 1u == gl_NumWorkGroups.x;
  if (chunkRoots[chunk] == 0u && !isLast) return;
  uint sum = 0u;
  for (uint i = own; i < chunk; i += uint(kRegionGroup)) sum += chunkRoots[i];
  if (sum != 0u) atomicAdd(before, sum);
  for (uint i = own; i < kRegionChunk; i += uint(kRegionGroup)) {
    uint pixel = chunk * kRegionChunk + i;
    if (pixel < pixelCount && parents[pixel] == pixel && roots[pixel] != 0u)
      atomicOr(bits[i / 32u], 1u << (i % 32u));
  }
  barrier();
  if (isLast && own == 0u) table.regionCount = before + chunkRoots[chunk];
  for (uint i = own; i < kRegionChunk; i += uint(kRegionGroup)) {
    if ((bits[i / 32u] >> (i % 32u) & 1u) == 0u) continue;
    uint rank = before + uint(bitCount(bits[i / 32u] & ((1u << (i % 32u)) - 1u)));
    for (uint word = 0u; word < i / 32u; ++word) rank += uint(bitCount(bits[word]));
    uint pixel = chunk * kRegionChunk + i;
    regions[rank] = RegionRecord(0u, uint[4](0u, 0u, 0u, 0u), 0u, kNone, kNone, 0u, 0u, 0u, 0u, 0u, 0u, 0.0, 0.0);
    roots[pixel] = rank + 1u;
  }
}
