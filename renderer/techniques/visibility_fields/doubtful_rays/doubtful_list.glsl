// SPDX-License-Identifier: BSD-3-Clause
// The list of rays about which fields are in doubt (DoubtfulRays). FIELD_DOUBT; otherwise there are none. All invocations of a work group call
// beginRays() and endRays(), and count each of their rays between. After field_seen.glsl.
#ifdef FIELD_DOUBT
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

layout(std430, binding = kDoubtListBuffer) buffer DoubtList {
  DoubtListHeader doubtList;
  uint doubtEntries[];
};
layout(std430, binding = kDoubtSumsBuffer) writeonly buffer DoubtSums { uint doubtSums[]; };
uniform float doubtDifference;
uniform uint doubtCapacity;

const uint kDoubtGathered = 1024u;  // of a work group; further ones are listed one by one
shared uint doubtRays[kDoubtGathered];
shared uint doubtCount, doubtBase;
float doubtLookedUp = 0.0;

// `entry`: number of the invocation in its work group + 64 times that of its ray.
void listRay(uint place, uint entry) {
  const ivec2 pixel = ivec2(gl_WorkGroupID.xy) * kGroupSide + ivec2(entry % uint(kGroupSide), entry / uint(kGroupSide) % uint(kGroupSide));
  const uint ray = entry / uint(kGroupSide * kGroupSide);
  if (place < doubtCapacity) doubtEntries[place] = uint(pixel.y * sizePx.x + pixel.x) * uint(raySide * raySide) + ray;
}
#endif

void beginRays() {
#ifdef FIELD_DOUBT
  if (gl_LocalInvocationIndex == 0u) doubtCount = 0u;
  barrier();
#endif
}

// What the ray last looked up, which sees the share `seen`, adds to its pixel's sum.
float countedRay(int ray, float seen) {
#ifdef FIELD_DOUBT
  if (fieldRange.y - fieldRange.x <= doubtDifference) return seen;
  doubtLookedUp += seen;
  const uint entry = gl_LocalInvocationIndex + uint(kGroupSide * kGroupSide) * uint(ray);
  const uint place = atomicAdd(doubtCount, 1u);
  if (place < kDoubtGathered) doubtRays[place] = entry;
  else listRay(atomicAdd(doubtList.rays, 1u), entry);
  return 0.0;
#else
  return seen;
#endif
}

void endRays(ivec2 pixel) {
#ifdef FIELD_DOUBT
  barrier();
  const uint gathered = min(doubtCount, kDoubtGathered);
  if (gl_LocalInvocationIndex == 0u && gathered > 0u) doubtBase = atomicAdd(doubtList.rays, gathered);
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < gathered; i += uint(kGroupSide * kGroupSide)) listRay(doubtBase + i, doubtRays[i]);
  if (all(lessThan(pixel, sizePx))) doubtSums[2 * (pixel.y * sizePx.x + pixel.x) + 1] = uint(doubtLookedUp * kDoubtUnit + 0.5);
#endif
}
