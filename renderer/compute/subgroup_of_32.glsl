// SPDX-License-Identifier: BSD-3-Clause
// Subgroups of 32 invocations: the device's or, with EMULATED_SUBGROUPS, a work group of 32 that stands for one, so that what only some
// devices have is tested on all. Included first. What is emulated must be called by all invocations of the group.
#ifndef EMULATED_SUBGROUPS
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_shuffle : require
uint ownSubgroup() { return gl_SubgroupID; }
uint ownLane() { return gl_SubgroupInvocationID; }
#else
uint ownSubgroup() { return 0u; }
uint ownLane() { return gl_LocalInvocationIndex; }
shared uint emulatedLanes[32];

void subgroupBarrier() { barrier(); }
void subgroupMemoryBarrierShared() { memoryBarrierShared(); }

void emulatedShare(uint value) {
  barrier();
  emulatedLanes[gl_LocalInvocationIndex] = value;
  barrier();
}
uint subgroupShuffle(uint value, uint from) {
  emulatedShare(value);
  return emulatedLanes[from];
}
uint subgroupInclusiveAdd(uint value) {
  emulatedShare(value);
  uint sum = 0u;
  for (uint i = 0u; i <= gl_LocalInvocationIndex; ++i) sum += emulatedLanes[i];
  return sum;
}
uint subgroupAdd(uint value) {
  emulatedShare(value);
  uint sum = 0u;
  for (uint i = 0u; i < 32u; ++i) sum += emulatedLanes[i];
  return sum;
}
uint subgroupMin(uint value) {
  emulatedShare(value);
  uint least = 0xffffffffu;
  for (uint i = 0u; i < 32u; ++i) least = min(least, emulatedLanes[i]);
  return least;
}
#endif
