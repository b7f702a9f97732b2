// SPDX-License-Identifier: BSD-3-Clause
// 16 bytes an invocation.
#include "renderer/techniques/stream_reduction/stream_bindings.h"

layout(local_size_x = kStreamCopyGroup) in;
layout(std430, binding = kStreamItemsBuffer) readonly buffer From { uvec4 from[]; };
layout(std430, binding = kStreamCopyBuffer) writeonly buffer To { uvec4 to[]; };
uniform uint quads;

void main() {
  const uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kStreamCopyGroup) + gl_LocalInvocationIndex;
  if (i < quads) to[i] = from[i];
}
