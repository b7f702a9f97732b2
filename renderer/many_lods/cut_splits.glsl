// SPDX-License-Identifier: BSD-3-Clause
// What a step's codes make of entries. The including shader has `splitLevels`, and tree_links.glsl.

uint ancestorOf(uint node, uint levels) {
  for (uint i = 0u; i < levels; ++i) node = parentOf(node);
  return node;
}

// The largest part of a split that takes no more than `room`: without the last nodes of the deepest level, and so on up.
uint within(uint splits, uint room) {
  uint levels = splitLevels;
  while (uint(bitCount(splits)) > room) {
    levels -= arityBits;
    const uint first = 1u << levels;
    while (uint(bitCount(splits)) > room) {
      const uint here = splits >> (first - 1u) & ((1u << first) - 1u);
      if (here == 0u) break;
      // A node of this level and all between it and its children.
      const uint place = first + uint(findMSB(here));
      for (uint below = 0u; below < arityBits; ++below)
        splits &= ~(((1u << (1u << below)) - 1u) << ((place << below) - 1u));
    }
  }
  return splits;
}
