// SPDX-License-Identifier: BSD-3-Clause
// What becomes of each entry of the list in a step, and for tiles of the list how many entries that makes. RULE: one of kRule...
#include "renderer/many_lods/node_predicate.glsl"
#include "renderer/many_lods/cut_lists.glsl"

layout(local_size_x = kCutGroup) in;
layout(std430, binding = kCutNodesBuffer) readonly buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kCutCodesBuffer) writeonly buffer Codes { uvec4 codes[]; };  // kCutRows words each
layout(std430, binding = kCutTilesBuffer) writeonly buffer Tiles { uvec2 tiles[]; };

uniform int splitLevels;  // that a step may split at once, up to kSplitLevels

shared uint sums[2];
shared uint unfinished;
#ifdef COUNTING
shared uint testCount, mergeCount;
uint tested = 0u, climbed = 0u;
#endif

bool valid(uint node, CutView view) {
#ifdef COUNTING
  ++tested;
#endif
  return isValid(nodes[node], node, leaves, view);
}

// `node` is not fine enough: which nodes of the subtree below it are split, too.
uint splitsBelow(uint node, CutView view) {
  uint mask = 1u;
  for (uint child = 2u; child < 1u << splitLevels; ++child) {
    if ((mask >> ((child >> 1u) - 1u) & 1u) == 0u) continue;
    const int level = findMSB(child);
    const uint there = (node << level) + child - (1u << level);
    if (!valid(there, view)) mask |= 1u << (child - 1u);
  }
  // Children of the last level split have not been looked at.
  const uint last = mask >> ((1u << (splitLevels - 1)) - 1u);
  if (last != 0u && (node << splitLevels) < leaves) unfinished = 1u;
  return mask;
}

uint codeOf(uvec2 before, uvec2 entry, uvec2 after) {
  const uint node = entry.x;
#if RULE == 0
  if ((entry.y & kEntryDone) != 0u) return 0u;
#endif
  const uint viewNumber = entry.y & ~kEntryDone;
  const CutView view = views[viewNumber];
#if RULE == 0
  return valid(node, view) ? 0u : splitsBelow(node, view);
#elif RULE == 1
  if (!valid(node, view)) return splitsBelow(node, view);
  // All below a valid ancestor climb; the first of them on the way down arrives.
  uint up = 0u;
  while (node >> up != kRootNode && valid(node >> (up + 1u), view)) {
    if ((node >> up & 1u) != 0u) return kCodeDropped;
    ++up;
  }
#ifdef COUNTING
  climbed += up;
#endif
  return up << 8u;
#else
  const bool fine = valid(node, view);
  const bool mayMerge = node != kRootNode && fine && valid(node >> 1u, view);
  const bool isFirst = (node & 1u) == 0u;
#if RULE == 2
  const uvec2 other = isFirst ? after : before;
  const bool both = other.x == (node ^ 1u) && (other.y & ~kEntryDone) == viewNumber;
  if (mayMerge && both) {
#else
  if (mayMerge) {
#endif
#ifdef COUNTING
    climbed += isFirst ? 1u : 0u;
#endif
    return isFirst ? 1u << 8u : kCodeDropped;
  }
  return fine ? 0u : 1u;
#endif
}

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint count = steps[step_].count, at = steps[step_].readAt;
  for (uint tile = gl_WorkGroupID.x; tile * uint(kCutTile) < count; tile += gl_NumWorkGroups.x) {
    if (me < 2u) sums[me] = 0u;
    if (me == 0u) unfinished = 0u;
    barrier();
    const uint first = tile * uint(kCutTile) + me * uint(kCutRows);
    uvec4 found = uvec4(kCodeDropped);
    uvec2 own = uvec2(0u);
    uvec2 before = uvec2(0u), entry = uvec2(0u);
    if (first < count) {
      entry = list[at + first];
      if (first > 0u) before = list[at + first - 1u];
    }
    for (uint row = 0u; row < uint(kCutRows); ++row) {
      if (first + row >= count) break;
      const uvec2 after = first + row + 1u < count ? list[at + first + row + 1u] : uvec2(0u);
      const uint code = codeOf(before, entry, after);
      found[row] = code;
      own += uvec2(code == kCodeDropped ? 0u : 1u, bitCount(code & 0x7fu));
      before = entry;
      entry = after;
    }
    codes[first / uint(kCutRows)] = found;
    if (own.x > 0u) atomicAdd(sums[0], own.x);
    if (own.y > 0u) atomicAdd(sums[1], own.y);
    barrier();
    if (me == 0u) {
      tiles[tile] = uvec2(sums[0], sums[1]);
      if (unfinished != 0u) steps[step_].unfinished = 1u;
    }
    barrier();
  }
#ifdef COUNTING
  if (me == 0u) testCount = mergeCount = 0u;
  barrier();
  atomicAdd(testCount, tested);
  atomicAdd(mergeCount, climbed);
  barrier();
  if (me == 0u) {
    atomicAdd(control.tests, testCount);
    atomicAdd(control.merges, mergeCount);
  }
#endif
}
