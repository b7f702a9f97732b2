// SPDX-License-Identifier: BSD-3-Clause
// What becomes of each entry of the list in a step, and for tiles of the list how many entries that makes. RULE: one of kRule...
// ORDERED: the list is kept in order, finished entries and others together. LINKED: tree_links.glsl. FIRST_HALF:
// of the tiles only.
#include "renderer/many_lods/node_predicate.glsl"
#include "renderer/many_lods/cut_lists.glsl"
#include "renderer/many_lods/tree_links.glsl"

layout(local_size_x = kCutGroup) in;
layout(std430, binding = kCutNodesBuffer) readonly buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kCutCodesBuffer) writeonly buffer Codes { uvec4 codes[]; };  // kCutRows words each
layout(std430, binding = kCutTilesBuffer) writeonly buffer Tiles { uvec4 tiles[]; };  // entries kept, splits, left over

uniform uint splitLevels;  // that a step may split at once, up to kMostSplitLevels; a multiple of arityBits

shared uint sums[3];
#ifdef COUNTING
shared uint testCount, mergeCount;
uint tested = 0u, climbed = 0u;
#endif

bool valid(uint node, CutView view) {
#ifdef COUNTING
  ++tested;
#endif
  const vec4 sphere = nodes[node];
  return isLeaf(node) || isFineEnough(sphere, view) || isCulledAt(sphere.xyz, sphere.w, levelsAboveLeaves(node), view);
}

// `node` is not fine enough: which nodes of the subtree below it are split, too. Between the levels of a tree whose nodes have more than
// two children, all are.
uint splitsBelow(uint node, CutView view) {
  uint mask = kCodeSplit;
  for (uint place = 2u; place < 1u << splitLevels; ++place) {
    if ((mask >> ((place >> 1u) - 1u) & 1u) == 0u) continue;
    const bool between = uint(findMSB(place)) % arityBits != 0u;
    if (between || !valid(nodeBelow(node, place), view)) mask |= 1u << (place - 1u);
  }
  return mask;
}

#if RULE == 2
// All children of a node follow each other: if the first and the last are in their places, so are those between, as every leaf is
// covered once.
bool allSiblingsAreThere(uint at, uint index, uint count, uvec2 entry) {
  const uint last = (1u << arityBits) - 1u, rank = entry.x & last;
  if (index < rank || index - rank + last >= count) return false;
  const uvec2 low = list[at + index - rank], high = list[at + index - rank + last];
  const uint view = entry.y & ~kEntryDone;
  return low.x == entry.x - rank && high.x == low.x + last && (low.y & ~kEntryDone) == view && (high.y & ~kEntryDone) == view;
}
#endif

uint codeOf(uint at, uint index, uint count) {
  const uvec2 entry = list[at + index];
  const uint node = entry.x;
#if RULE == 0 && defined(ORDERED)
  if ((entry.y & kEntryDone) != 0u) return 0u;
#endif
  const CutView view = views[entry.y & ~kEntryDone];
#if RULE == 0
  return valid(node, view) ? 0u : splitsBelow(node, view);
#elif RULE == 1
  if (!valid(node, view)) return splitsBelow(node, view);
  // All below a valid ancestor climb; the first of them on the way down arrives.
  uint up = 0u, above = node;
  while (above != kRootNode) {
    const uint parent = parentOf(above);
    if (!valid(parent, view)) break;
    if (!isFirstChild(above)) return kCodeDropped;
    above = parent;
    ++up;
  }
#ifdef COUNTING
  climbed += up;
#endif
  return up << kCodeClimbShift;
#else
  const bool fine = valid(node, view);
  bool merge = node != kRootNode && fine && valid(parentOf(node), view);
#if RULE == 2
  merge = merge && allSiblingsAreThere(at, index, count, entry);
#endif
  if (merge) {
#ifdef COUNTING
    climbed += isFirstChild(node) ? 1u : 0u;
#endif
    return isFirstChild(node) ? 1u << kCodeClimbShift : kCodeDropped;
  }
  // By one edge: a node and what lies between it and its children.
  return fine ? 0u : (1u << ((1u << arityBits) - 1u)) - 1u;
#endif
}

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
