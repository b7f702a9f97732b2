// SPDX-License-Identifier: BSD-3-Clause
// Numbers a volume's occupied voxels: each word of bits gets the number of its first one. A group's words are numbered one
// after another, groups in the order in which they come, which nothing that is made of the numbers shows.
#include "renderer/voxels/volume_words.glsl"

layout(binding = kVolumeSlotsImage, r32ui) uniform writeonly uimage2DArray slotsImage;
layout(std430, binding = kVolumeOccupiedBuffer) buffer Occupied { uint occupiedCount; };

shared uint groupCount, groupFirst;

void main() {
  const uint lane = gl_LocalInvocationIndex;
  if (lane == 0u) groupCount = 0u;
  barrier();
  const ivec3 texel = wordOf(lane);
  const uint word = isWord(texel) ? texelFetch(volumeBits, texel, 0).x : 0u;
  const uint at = word != 0u ? atomicAdd(groupCount, uint(bitCount(word))) : 0u;
  barrier();
  if (lane == 0u && groupCount > 0u) groupFirst = atomicAdd(occupiedCount, groupCount);
  barrier();
  if (word != 0u) imageStore(slotsImage, texel, uvec4(groupFirst + at));
}
