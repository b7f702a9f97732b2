// SPDX-License-Identifier: BSD-3-Clause
// Bits of a volume become 0, or (UNITE) the union with another's.
#include "renderer/voxels/volume_words.glsl"

layout(binding = kVolumeEmptyBitsImage, r32ui) uniform writeonly uimage2DArray bitsImage;
#ifdef NUMBERED
layout(std430, binding = kVolumeOccupiedBuffer) buffer Occupied { uint occupiedCount; };
#endif
#ifdef UNITE
layout(binding = kVolumeBaseBitsUnit) uniform usampler2DArray baseBits;
#endif

void main() {
#ifdef NUMBERED
  if (gl_WorkGroupID.xy == uvec2(0u) && gl_LocalInvocationIndex == 0u) occupiedCount = 0u;
#endif
  const ivec3 texel = wordOf(gl_LocalInvocationIndex);
  if (!isWord(texel)) return;
#ifdef UNITE
  const uint own = texelFetch(volumeBits, texel, 0).x, word = own | texelFetch(baseBits, texel, 0).x;
  if (word != own) imageStore(bitsImage, texel, uvec4(word));
#else
  imageStore(bitsImage, texel, uvec4(0u));
#endif
}
