// SPDX-License-Identifier: BSD-3-Clause
// How the nodes of a tree hang together: a complete tree in an array whose nodes have 2^arityBits children, or, LINKED, any binary tree
// whose nodes say so themselves (tree_shape.h). In both an inner node's children follow each other, the first at an even place.
#include "renderer/many_lods/many_lods_bindings.h"

uniform uint leaves;
#ifdef LINKED
layout(std430, binding = kCutLinksBuffer) readonly buffer Links { TreeLink links[]; };
const uint arityBits = 1u;
bool isLeaf(uint node) { return links[node].firstChild == 0u; }
uint parentOf(uint node) { return links[node].parent; }
uint levelsAboveLeaves(uint node) { return links[node].height; }
// `place`: of the node within the subtree below `node`, numbered as in a heap whose root is 1.
uint nodeBelow(uint node, uint place) {
  for (int bit = findMSB(place) - 1; bit >= 0; --bit) node = links[node].firstChild + (place >> uint(bit) & 1u);
  return node;
}
// Whether children that have not been looked at may have to be split.
bool mayGoOn(uint node, uint levels) { return true; }
#else
uniform uint arityBits;
bool isLeaf(uint node) { return node >= leaves; }
uint parentOf(uint node) { return node >> arityBits; }
uint levelsAboveLeaves(uint node) { return uint(findMSB(leaves) - findMSB(node)); }
uint nodeBelow(uint node, uint place) {
  const int level = findMSB(place);
  return (node << level) + place - (1u << level);
}
bool mayGoOn(uint node, uint levels) { return node << levels < leaves; }
#endif
bool isFirstChild(uint node) { return (node & ((1u << arityBits) - 1u)) == 0u; }

// Of a step that splits by up to `levels` levels at once: how many of the nodes that it makes of an entry the next step has to look at.
// `code` as in many_lods_bindings.h.
uint leftOver(uint code, uint node, uint levels) {
  if ((code & kCodeSplit) == 0u || !mayGoOn(node, levels)) return 0u;
  return 2u * uint(bitCount(code >> ((1u << (levels - 1u)) - 1u)));
}

uint splitsOf(uint code) { return (code & kCodeSplit) != 0u ? uint(bitCount(code)) : 0u; }
