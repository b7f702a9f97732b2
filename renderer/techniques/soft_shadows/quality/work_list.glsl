// SPDX-License-Identifier: BSD-3-Clause
// Pixels that need processing, in the order in which tiles of the image were done. Its first three words are the groups of
// 64 invocations of an indirect dispatch over them.
layout(std430, binding = 7) restrict buffer WorkList {
  uint groupsPerRow, groupRows, groupLayers;
  uint listedCount;
  uint listedPixels[];  // x in the lower half, y in the upper
};

// The pixel of this invocation; false: there is none.
bool listedPixel(out ivec2 pixel) {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const uint i = group * 64u + gl_LocalInvocationIndex;
  if (i >= listedCount) return false;
  pixel = ivec2(listedPixels[i] & 0xffffu, listedPixels[i] >> 16);
  return true;
}
