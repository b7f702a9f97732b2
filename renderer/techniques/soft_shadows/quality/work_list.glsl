// SPDX-License-Identifier: BSD-3-Clause
// Pixels that need processing, in the order in which tiles of the image were done. Its first three words are the groups of
// kWorkListGroup invocations of an indirect dispatch over them.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

layout(std430, binding = kWorkListBuffer) restrict buffer WorkList {
  WorkListHeader work;
  uint listedPixels[];
};

// The pixel of this invocation; false: there is none.
bool listedPixel(out ivec2 pixel) {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const uint i = group * kWorkListGroup + gl_LocalInvocationIndex;
  if (i >= work.pixelCount) return false;
  pixel = ivec2(listedPixels[i] & 0xffffu, listedPixels[i] >> 16);
  return true;
}
