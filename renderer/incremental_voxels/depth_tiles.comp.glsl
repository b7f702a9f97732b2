// SPDX-License-Identifier: BSD-3-Clause
// Least and largest depth of each tile of a depth image; 0 where nothing is seen. A tile a group, a pixel an invocation.
#include "renderer/incremental_voxels/incremental_bindings.h"

layout(local_size_x = kDepthTile, local_size_y = kDepthTile) in;
layout(binding = kViewDepthsUnit) uniform sampler2D depths;
layout(binding = kDepthTilesImage, rg32f) uniform writeonly image2D tilesImage;

// Floats that are not negative are in the order of their bits.
shared uint least, largest;

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    least = 0xffffffffu;
    largest = 0u;
  }
  barrier();
  const ivec2 pixel = min(ivec2(gl_GlobalInvocationID.xy), textureSize(depths, 0) - 1);
  const float depth = max(texelFetch(depths, pixel, 0).x, 0.0);
  atomicMin(least, floatBitsToUint(depth));
  atomicMax(largest, floatBitsToUint(depth));
  barrier();
  if (gl_LocalInvocationIndex == 0u)
    imageStore(tilesImage, ivec2(gl_WorkGroupID.xy), vec4(uintBitsToFloat(least), uintBitsToFloat(largest), 0.0, 0.0));
}
