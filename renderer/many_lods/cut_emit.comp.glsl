// SPDX-License-Identifier: BSD-3-Clause
// Writes the list that a step makes, in the same order: by view, then from left to right in the tree.
#include "renderer/many_lods/cut_lists.glsl"

layout(local_size_x = kCutGroup) in;
layout(std430, binding = kCutCodesBuffer) readonly buffer Codes { uvec4 codes[]; };
layout(std430, binding = kCutTilesBuffer) readonly buffer Tiles { uvec2 tiles[]; };

uniform int splitLevels;

shared uint line[kCutGroup];

// Entries and splits of an invocation in one word: 4 and 28 at most, of a tile 1024 and 7168.
uint packedSum(uvec4 found) {
  uint sum = 0u;
  for (int row = 0; row < kCutRows; ++row)
    sum += (found[row] == kCodeDropped ? 0u : 1u) + (uint(bitCount(found[row] & 0x7fu)) << 16u);
  return sum;
}

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint count = steps[step_].count, readAt = steps[step_].readAt, budget = steps[step_].budget;
  const uint writeAt = capacity - readAt;
  for (uint tile = gl_WorkGroupID.x; tile * uint(kCutTile) < count; tile += gl_NumWorkGroups.x) {
    const uint first = tile * uint(kCutTile) + me * uint(kCutRows);
    const uvec4 found = codes[first / uint(kCutRows)];
    const uint own = packedSum(found);
    barrier();
    line[me] = own;
    barrier();
    for (uint distance_ = 1u; distance_ < uint(kCutGroup); distance_ *= 2u) {
      uint upTo = line[me];
      if (me >= distance_) upTo += line[me - distance_];
      barrier();
      line[me] = upTo;
      barrier();
    }
    const uint before = line[me] - own;
    uvec2 at = tiles[tile] + uvec2(before & 0xffffu, before >> 16u);
    for (uint row = 0u; row < uint(kCutRows); ++row) {
      if (first + row >= count) break;
      const uint code = found[row];
      if (code == kCodeDropped) continue;
      const uvec2 entry = list[readAt + first + row];
      const uint view = entry.y & ~kEntryDone;
      uint to = writeAt + at.x + min(at.y, budget);
      const uint splits = code & 0x7fu;
      at += uvec2(1u, uint(bitCount(splits)));
      if (splits == 0u) {
        list[to] = uvec2(entry.x >> (code >> 8u & 31u), view | kEntryDone);
        continue;
      }
      // Parents come before children: what remains of the splits is a subtree.
      uint kept = splits;
      const uint room = budget - min(budget, at.y - uint(bitCount(splits)));
      while (uint(bitCount(kept)) > room) kept &= ~(1u << findMSB(kept));
      uint place = 1u;
      while (place != 0u) {
        if (place < 8u && (kept >> (place - 1u) & 1u) != 0u) {
          place *= 2u;
          continue;
        }
        const int level = findMSB(place);
        const uint node = (entry.x << level) + place - (1u << level);
        list[to++] = uvec2(node, level < splitLevels || node >= leaves ? view | kEntryDone : view);
        while ((place & 1u) != 0u) place >>= 1u;
        if (place != 0u) ++place;
      }
    }
  }
}
