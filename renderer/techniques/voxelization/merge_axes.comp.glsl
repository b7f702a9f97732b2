// SPDX-License-Identifier: BSD-3-Clause
// The union of three volumes whose layers lie across an axis each: a word of the result an invocation. Volumes with
// attributes say in green of their first attachment what is occupied.
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/volume.glsl"

layout(local_size_x = 1, local_size_y = 64) in;
layout(binding = kAxisVolumeXUnit) uniform sampler2DArray alongX;
layout(binding = kAxisVolumeYUnit) uniform sampler2DArray alongY;
layout(binding = kAxisVolumeZUnit) uniform sampler2DArray alongZ;
layout(binding = kMergedBitsImage, r32ui) uniform writeonly uimage2DArray bitsImage;

#ifdef SUMS
float occupied(vec4 texel) { return texel.y; }
#else
float occupied(vec4 texel) { return texel.x; }
#endif

void main() {
  const ivec3 texel = ivec3(gl_GlobalInvocationID);
  if (texel.y >= gridSizeY) return;
  uint word = 0u;
  const int count = min(32, gridSizeX - 32 * texel.x);
  for (int i = 0; i < count; ++i) {
    const ivec3 v = ivec3(32 * texel.x + i, texel.yz);
    const float most = max(occupied(texelFetch(alongX, v.yzx, 0)),
                           max(occupied(texelFetch(alongY, v.zxy, 0)), occupied(texelFetch(alongZ, v, 0))));
    if (most > 0.5) word |= 1u << i;
  }
  imageStore(bitsImage, texel, uvec4(word));
}
