// SPDX-License-Identifier: BSD-3-Clause
// Items and output one at a time, after reduction_items.glsl.
layout(std430, binding = kReductionItemsBuffer) readonly buffer Items { ITEM items[]; };
#ifdef FLAGGED
layout(std430, binding = kReductionFlagsBuffer) readonly buffer Flags { uint flags[]; };
#endif
layout(std430, binding = kReductionOutBuffer) writeonly buffer Out { ITEM kept[]; };

// False from `count` on.
bool isValid(uint i, uint count) {
  if (i >= count) return false;
#ifdef FLAGGED
  return flags[i] != 0u;
#else
  return FIRST_WORD(items[i]) != kInvalidItem;
#endif
}

void put(uint slot, ITEM item) {
  if (slot < capacity) kept[slot] = item;
}
