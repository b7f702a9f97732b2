// SPDX-License-Identifier: BSD-3-Clause
// The union of bit masks seen along one or three axes: a word of the result an invocation. A layer of a mask's array holds
// 128 voxels along its axis.
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/volume.glsl"

layout(local_size_x = 1, local_size_y = 64) in;
layout(binding = kMergedBitsImage, r32ui) uniform writeonly uimage2DArray bitsImage;
#ifdef SEEN_X
layout(binding = kMaskXUnit) uniform usampler2DArray maskX;
#endif
#ifdef SEEN_Y
layout(binding = kMaskYUnit) uniform usampler2DArray maskY;
#endif
#ifdef SEEN_Z
layout(binding = kMaskZUnit) uniform usampler2DArray maskZ;
#endif

uint bitOf(uvec4 mask, int place) { return mask[(place >> 5) & 3] >> (place & 31) & 1u; }

void main() {
  const ivec3 texel = ivec3(gl_GlobalInvocationID);
  if (texel.y >= gridSizeY) return;
  uint word = 0u;
#ifdef SEEN_X
  word = texelFetch(maskX, ivec3(texel.yz, texel.x >> 2), 0)[texel.x & 3];
#endif
  const int count = min(32, gridSizeX - 32 * texel.x);
  for (int i = 0; i < count; ++i) {
    const ivec3 v = ivec3(32 * texel.x + i, texel.yz);
#ifdef SEEN_Y
    word |= bitOf(texelFetch(maskY, ivec3(v.zx, v.y >> 7), 0), v.y) << i;
#endif
#ifdef SEEN_Z
    word |= bitOf(texelFetch(maskZ, ivec3(v.xy, v.z >> 7), 0), v.z) << i;
#endif
  }
  imageStore(bitsImage, texel, uvec4(word));
}
