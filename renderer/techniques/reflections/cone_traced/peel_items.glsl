// SPDX-License-Identifier: BSD-3-Clause
// Pairs of a pixel and a triangle, for peeling. See peeling.h.
layout(binding = kPeelCounter, offset = 0) uniform atomic_uint itemCount;
layout(binding = kPeelKeysImage, rgba32ui) uniform writeonly uimage2D itemKeys;
layout(binding = kPeelColoursImage, rgba32f) uniform writeonly image2D itemColours;
uniform uint itemRoom;

void addItem(ivec2 pixel, float along, float share, vec3 colour) {
  const uint index = atomicCounterIncrement(itemCount);
  if (index >= itemRoom) return;
  const ivec2 at = ivec2(index % uint(kPeelItemsAcross), index / uint(kPeelItemsAcross));
  imageStore(itemKeys, at, uvec4(pixel, floatBitsToUint(along), 0u));
  imageStore(itemColours, at, vec4(colour, share));
}
