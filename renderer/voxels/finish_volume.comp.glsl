// SPDX-License-Identifier: BSD-3-Clause
// Attachments of occupied voxels from their sums, which become 0 (BASE: with another volume's, which stay); or (ERASE) 0
// in voxels that were occupied. A group lists the occupied voxels of its words and shares them.
#include "renderer/voxels/voxel_slots.glsl"
#include "renderer/voxels/volume_words.glsl"

layout(std430, binding = kVoxelSumsBuffer) buffer Sums { uint voxelSums[]; };
#ifdef BASE
layout(std430, binding = kVolumeBaseSumsBuffer) readonly buffer BaseSums { uint baseSums[]; };
#ifdef OCCUPIED_SUMS
layout(binding = kVolumeBaseBitsUnit) uniform usampler2DArray baseBits;
layout(binding = kVolumeBaseSlotsUnit) uniform usampler2DArray baseSlots;
uniform uint baseCapacity;
uint baseSlotOf(ivec3 voxel) {
  const ivec3 texel = ivec3(voxel.x >> 5, voxel.yz);
  return slotIn(texelFetch(baseBits, texel, 0).x, texelFetch(baseSlots, texel, 0).x, uint(voxel.x & 31), baseCapacity);
}
#else
uint baseSlotOf(ivec3 voxel) { return slotOf(voxel); }
#endif
#endif
uniform float sumSteps, lightSteps;
#ifdef VOLUME_OCCUPANCY
layout(binding = kVolumeOccupancyImage, VOLUME_FORMAT) uniform writeonly image2DArray occupancyImage;
#endif
#ifdef VOLUME_ALBEDO
layout(binding = kVolumeAlbedoImage, VOLUME_FORMAT) uniform writeonly image2DArray albedoImage;
#endif
#ifdef VOLUME_NORMAL
layout(binding = kVolumeNormalImage, VOLUME_FORMAT) uniform writeonly image2DArray normalImage;
#endif
#ifdef VOLUME_LIGHT
layout(binding = kVolumeLightImage, VOLUME_FORMAT) uniform writeonly image2DArray lightImage;
#endif
#ifdef VOLUME_SH_GREY
layout(binding = kVolumeShGreyImage, VOLUME_FORMAT) uniform writeonly image2DArray shGreyImage;
#endif
#ifdef VOLUME_SH_RED
layout(binding = kVolumeShRedImage, VOLUME_FORMAT) uniform writeonly image2DArray shRedImage;
layout(binding = kVolumeShGreenImage, VOLUME_FORMAT) uniform writeonly image2DArray shGreenImage;
layout(binding = kVolumeShBlueImage, VOLUME_FORMAT) uniform writeonly image2DArray shBlueImage;
#endif

#ifdef ERASE
void finishVoxel(ivec3 voxel) {
  const vec4 nothing = vec4(0.0);
#ifdef VOLUME_OCCUPANCY
  imageStore(occupancyImage, voxel, nothing);
#endif
#ifdef VOLUME_ALBEDO
  imageStore(albedoImage, voxel, nothing);
#endif
#ifdef VOLUME_NORMAL
  imageStore(normalImage, voxel, nothing);
#endif
#ifdef VOLUME_LIGHT
  imageStore(lightImage, voxel, nothing);
#endif
#ifdef VOLUME_SH_GREY
  imageStore(shGreyImage, voxel, nothing);
#endif
#ifdef VOLUME_SH_RED
  imageStore(shRedImage, voxel, nothing);
  imageStore(shGreenImage, voxel, nothing);
  imageStore(shBlueImage, voxel, nothing);
#endif
}
#else
uint slot = kNoSlot, baseSlot = kNoSlot;  // of the voxel in hand

uint takeSum(uint word) {
  uint sum = 0u;
  if (slot != kNoSlot) {
    sum = voxelSums[SUMS * slot + word];
    voxelSums[SUMS * slot + word] = 0u;
  }
#ifdef BASE
  if (baseSlot != kNoSlot) sum += baseSums[SUMS * baseSlot + word];
#endif
  return sum;
}
vec3 takeUnsigned(uint at, float scale) {
  const uint x = takeSum(at), y = takeSum(at + 1u), z = takeSum(at + 2u);
  return scale * vec3(x, y, z);
}
vec3 takeSigned(uint at, float scale) {
  const int x = int(takeSum(at)), y = int(takeSum(at + 1u)), z = int(takeSum(at + 2u));
  return scale * vec3(x, y, z);
}
vec4 takeLobe(uint at, float scale) { return vec4(scale * float(takeSum(at)), takeSigned(at + 1u, scale)); }

void finishVoxel(ivec3 voxel) {
  slot = slotOf(voxel);
#ifdef BASE
  baseSlot = baseSlotOf(voxel);
#endif
  const uint entries = takeSum(0u);
  const float share = entries > 0u ? 1.0 / float(entries) : 0.0;
  const float scale = share / sumSteps, lightScale = share / lightSteps, one = entries > 0u ? 1.0 : 0.0;
#ifdef SUM_OPACITY
  const float opacity = scale * float(takeSum(SUM_OPACITY));
#endif
#ifdef VOLUME_OCCUPANCY
  imageStore(occupancyImage, voxel, vec4(opacity, entries, 0.0, 0.0));
#endif
#ifdef VOLUME_ALBEDO
  imageStore(albedoImage, voxel, vec4(takeUnsigned(SUM_ALBEDO, scale), one));
#endif
#ifdef VOLUME_NORMAL
  imageStore(normalImage, voxel, vec4(takeSigned(SUM_NORMAL, scale), opacity));
#endif
#ifdef VOLUME_LIGHT
  imageStore(lightImage, voxel, vec4(takeUnsigned(SUM_LIGHT, lightScale), one));
#endif
#ifdef VOLUME_SH_GREY
  imageStore(shGreyImage, voxel, takeLobe(SUM_SH_GREY, lightScale));
#endif
#ifdef VOLUME_SH_RED
  imageStore(shRedImage, voxel, takeLobe(SUM_SH_RED, lightScale));
  imageStore(shGreenImage, voxel, takeLobe(SUM_SH_GREEN, lightScale));
  imageStore(shBlueImage, voxel, takeLobe(SUM_SH_BLUE, lightScale));
#endif
}
#endif

shared uint listed;
shared uint list[32 * kVolumeWords];  // lane and bit of each occupied voxel

void main() {
  const uint lane = gl_LocalInvocationIndex;
  if (lane == 0u) listed = 0u;
  barrier();
  const ivec3 texel = wordOf(lane);
  uint word = isWord(texel) ? texelFetch(volumeBits, texel, 0).x : 0u;
  if (word != 0u) {
    uint at = atomicAdd(listed, uint(bitCount(word)));
    for (; word != 0u; word &= word - 1u) list[at++] = 32u * lane + uint(findLSB(word));
  }
  barrier();
  for (uint i = lane; i < listed; i += uint(kVolumeWords)) {
    const ivec3 from = wordOf(list[i] >> 5);
    finishVoxel(ivec3(32 * from.x + int(list[i] & 31u), from.yz));
  }
}
