// SPDX-License-Identifier: BSD-3-Clause
// Bits of occupied voxels, a word an invocation, for the picture.
#include "renderer/techniques/incremental_voxelization/voxel_textures.glsl"
#include "renderer/voxels/volume.glsl"

layout(local_size_x = 1, local_size_y = 64) in;
layout(binding = kVoxelSourceUnit) uniform VOXEL_SAMPLER source;
layout(binding = kPackedBitsImage, r32ui) uniform writeonly uimage2DArray bitsImage;

void main() {
  const ivec3 texel = ivec3(gl_GlobalInvocationID);
  if (texel.y >= gridSizeY) return;
  uint word = 0u;
  const int count = min(32, gridSizeX - 32 * texel.x);
  for (int i = 0; i < count; ++i)
    if (texelFetch(source, texelOf(ivec3(32 * texel.x + i, texel.yz), gridSize()), 0).w > 0.0) word |= 1u << i;
  imageStore(bitsImage, texel, uvec4(word));
}
