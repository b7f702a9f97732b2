// SPDX-License-Identifier: BSD-3-Clause
// What becomes of an entry in a step. RULE: one of kRule..., ORDERED: entries may be finished already. LINKED: tree_links.glsl. The
// including shader has `nodes`, `views` and the list. MARGINS: entries that are right are tested again when something has moved by what
// was left at their last test.
#include "renderer/many_lods/node_predicate.glsl"
#include "renderer/many_lods/cut_lists.glsl"
#include "renderer/many_lods/tree_links.glsl"

#if defined(MARGINS) && RULE == 1
layout(std430, binding = kCutMotionsBuffer) readonly buffer Motions { vec2 motions[]; };  // of views, cut_motion.comp.glsl
#endif

uniform uint splitLevels;  // that a step may split at once, up to kMostSplitLevels; a multiple of arityBits

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

#if RULE == 1
// Siblings stand beside each other in a list, and an invocation looks at entries that do: their parent is tested once.
uint knownParent = 0u, knownView = 0u;
bool knownValid = false;
#ifdef MARGINS
vec2 knownMargins;  // if it is not valid
#endif

bool isParentValid(uint parent, uint viewNumber, CutView view) {
  if (parent == knownParent && viewNumber == knownView) return knownValid;
  knownParent = parent;
  knownView = viewNumber;
  knownValid = valid(parent, view);
#ifdef MARGINS
  if (!knownValid) knownMargins = marginsOf(nodes[parent], levelsAboveLeaves(parent), view, false);
#endif
  return knownValid;
}
#endif

uint codeOf(uint at, uint index, uint count) {
  const uvec2 entry = list[at + index];
  const uint node = entry.x;
#if RULE == 0 && defined(ORDERED)
  if ((entry.y & kEntryDone) != 0u) return 0u;
#endif
  const uint viewNumber = entry.y & ~kEntryDone;
#if defined(MARGINS) && RULE == 1
  const vec2 motion = motions[viewNumber];
  const vec2 rest = unpackedMargins(margins[at + index]) - motion;
  if (all(greaterThan(rest, vec2(0.0)))) {
    if (motion.y > 0.0) margins[at + index] = packedMargins(rest);
    return 0u;
  }
#endif
  const CutView view = views[viewNumber];
#if RULE == 0
  return valid(node, view) ? 0u : splitsBelow(node, view);
#elif RULE == 1
#ifdef SPLITS_LATER
  if (!valid(node, view)) return kCodeOpen;
#else
  if (!valid(node, view)) return splitsBelow(node, view);
#endif
  // All below a valid ancestor climb; the first of them on the way down arrives.
  uint up = 0u, above = node;
  while (above != kRootNode) {
    const uint parent = parentOf(above);
    if (!isParentValid(parent, viewNumber, view)) break;
    if (!isFirstChild(above)) return kCodeDropped;
    above = parent;
    ++up;
  }
#ifdef COUNTING
  climbed += up;
#endif
#ifdef MARGINS
  vec2 still = isLeaf(above) ? vec2(kNoMargin) : marginsOf(nodes[above], levelsAboveLeaves(above), view, true);
  if (above != kRootNode) still = min(still, knownMargins);
  margins[at + index] = packedMargins(still);
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

#ifdef COUNTING
// By all of the group.
void addCounts() {
  if (gl_LocalInvocationIndex == 0u) testCount = mergeCount = 0u;
  barrier();
  atomicAdd(testCount, tested);
  atomicAdd(mergeCount, climbed);
  barrier();
  if (gl_LocalInvocationIndex == 0u) {
    atomicAdd(control.tests, testCount);
    atomicAdd(control.merges, mergeCount);
  }
}
#endif
