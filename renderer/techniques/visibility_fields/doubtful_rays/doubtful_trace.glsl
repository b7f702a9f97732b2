// SPDX-License-Identifier: BSD-3-Clause
// One invocation traces a listed ray. Sums are of whole numbers: the same in any order. After field_receiver.glsl.
#include "renderer/techniques/visibility_fields/object_trace.glsl"

layout(std430, binding = kDoubtListBuffer) readonly buffer DoubtList {
  DoubtListHeader doubtList;
  uint doubtEntries[];
};
layout(std430, binding = kDoubtSumsBuffer) buffer DoubtSums { uint doubtSums[]; };

// The ray of this invocation.
bool doubtfulRay(out ivec2 pixel, out int ray) {
  const uint place = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kDoubtGroup) + gl_LocalInvocationIndex;
  if (place >= doubtList.listed) return false;
  const uint entry = doubtEntries[place], rays = uint(raySide * raySide), number = entry / rays;
  pixel = ivec2(number % uint(sizePx.x), number / uint(sizePx.x));
  ray = int(entry % rays);
  return true;
}

void addTraced(ivec2 pixel, float seen) {
  const int place = 2 * (pixel.y * sizePx.x + pixel.x);
  if (rayCutShort) atomicOr(doubtSums[place], kDoubtCutShort);
  else if (seen > 0.0) atomicAdd(doubtSums[place], uint(seen * kDoubtUnit + 0.5));
}
