// SPDX-License-Identifier: BSD-3-Clause
// A work group shares the rays of a listed pixel, which are traced. After field_receiver.glsl.
#include "renderer/techniques/visibility_fields/object_trace.glsl"

layout(std430, binding = kNearListBuffer) readonly buffer NearList {
  NearListHeader nearList;
  uint nearPixels[];
};

// The pixel of this work group.
bool nearPixel(out ivec2 pixel) {
  const uint place = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (place >= nearList.listed) return false;
  const uint word = nearPixels[place];
  pixel = ivec2(word & 0xffffu, word >> 16);
  return true;
}

shared float nearSums[kNearGroup];
shared uint nearCutShort;
// Sum over the work group's invocations, all of which call it, in a fixed order: the same bytes in every run. NaN if a ray was cut short.
float nearSum(float value) {
  const int lane = int(gl_LocalInvocationIndex);
  if (lane == 0) nearCutShort = 0u;
  nearSums[lane] = value;
  barrier();
  if (rayCutShort) atomicOr(nearCutShort, 1u);
  for (int width = kNearGroup / 2; width > 0; width /= 2) {
    if (lane < width) nearSums[lane] += nearSums[lane + width];
    barrier();
  }
  return nearCutShort != 0u ? uintBitsToFloat(0x7fc00000u) : nearSums[0];
}
