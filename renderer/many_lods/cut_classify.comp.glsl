// SPDX-License-Identifier: BSD-3-Clause
// What becomes of each entry of the list in a step, and for tiles of the list how many entries that makes. RULE: one of kRule...
// ORDERED: the list is kept in order, finished entries and others together. LINKED: tree_links.glsl. FIRST_HALF:
// of the tiles only.
#include "renderer/many_lods/many_lods_bindings.h"

layout(local_size_x = kCutGroup) in;
layout(std430, binding = kCutNodesBuffer) readonly buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kCutCodesBuffer) writeonly buffer Codes { uvec4 codes[]; };  // kCutRows words each
layout(std430, binding = kCutTilesBuffer) writeonly buffer Tiles { uvec4 tiles[]; };  // entries kept, splits, left over

#include "renderer/many_lods/cut_events.glsl"

shared uint sums[3];

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint count = steps[step_].count, at = steps[step_].readAt;
  uint tileCount = (count + uint(kCutTile) - 1u) / uint(kCutTile);
#ifdef FIRST_HALF
  tileCount /= 2u;
#endif
  for (uint tile = gl_WorkGroupID.x; tile < tileCount; tile += gl_NumWorkGroups.x) {
    if (me < 3u) sums[me] = 0u;
    barrier();
    const uint first = tile * uint(kCutTile) + me * uint(kCutRows);
    uvec4 found = uvec4(kCodeDropped);
    uvec3 own = uvec3(0u);
    for (uint row = 0u; row < uint(kCutRows); ++row) {
      if (first + row >= count) break;
      const uint code = codeOf(at, first + row, count);
      if (row == 0u) found.x = code;
      else if (row == 1u) found.y = code;
      else if (row == 2u) found.z = code;
      else found.w = code;
      own += uvec3(code == kCodeDropped ? 0u : 1u, splitsOf(code), leftOver(code, list[at + first + row].x, splitLevels));
    }
    codes[first / uint(kCutRows)] = found;
    if (own.x > 0u) atomicAdd(sums[0], own.x);
    if (own.y > 0u) atomicAdd(sums[1], own.y);
    if (own.z > 0u) atomicAdd(sums[2], own.z);
    barrier();
    if (me == 0u) tiles[tile] = uvec4(sums[0], sums[1], sums[2], 0u);
    barrier();
  }
#ifdef COUNTING
  addCounts();
#endif
}
