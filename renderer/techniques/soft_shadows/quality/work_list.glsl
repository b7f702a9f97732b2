// SPDX-License-Identifier: BSD-3-Clause
// Pixels that need processing, in the order in which tiles of the image were done. The header's first three words are the
// groups of kWorkListGroup invocations of an indirect dispatch over them.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

layout(std430, binding = kWorkHeaderBuffer) restrict buffer WorkHeader { WorkListHeader work; };
layout(std430, binding = kWorkListBuffer) restrict buffer WorkList { uint listedPixels[]; };

// The pixel of this invocation; false: there is none. LANES invocations share a pixel, one of each LANES-th of the group: neighbours
// in a group read texels for neighbouring pixels, which lie near each other.
bool listedPixel(out ivec2 pixel) {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
#if LANES > 1
  const uint i =
      group * kWorkListGroup + gl_WorkGroupID.z * (kWorkListGroup / LANES) + gl_LocalInvocationIndex % (kWorkListGroup / LANES);
#else
  if (gl_WorkGroupID.z > 0u) return false;  // is for those whose pixels have several invocations
  const uint i = group * kWorkListGroup + gl_LocalInvocationIndex;
#endif
  if (i >= work.pixelCount) return false;
  pixel = ivec2(listedPixels[i] & 0xffffu, listedPixels[i] >> 16);
  return true;
}
