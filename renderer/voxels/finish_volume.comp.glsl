// SPDX-License-Identifier: BSD-3-Clause
// Attachments of occupied voxels from their sums, which become 0 (BASE: with another volume's, which stay); or (ERASE) 0
// in voxels that were occupied. A group lists the occupied voxels of its words and shares them.
#include "renderer/voxels/volume_words.glsl"

layout(std430, binding = kVoxelSumsBuffer) buffer Sums { uint voxelSums[]; };
#ifdef BASE
layout(std430, binding = kVolumeBaseSumsBuffer) readonly buffer BaseSums { uint baseSums[]; };
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
uint takeSum(uint at) {
  const uint sum = voxelSums[at];
  voxelSums[at] = 0u;
#ifdef BASE
  return sum + baseSums[at];
#else
  return sum;
#endif
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
  const uint first = SUMS * uint(voxel.x + gridSizeX * (voxel.y + gridSizeY * voxel.z));
  const uint entries = takeSum(first);
  const float share = entries > 0u ? 1.0 / float(entries) : 0.0;
  const float scale = share / sumSteps, lightScale = share / lightSteps, one = entries > 0u ? 1.0 : 0.0;
#ifdef SUM_OPACITY
  const float opacity = scale * float(takeSum(first + SUM_OPACITY));
#endif
#ifdef VOLUME_OCCUPANCY
  imageStore(occupancyImage, voxel, vec4(opacity, entries, 0.0, 0.0));
#endif
#ifdef VOLUME_ALBEDO
  imageStore(albedoImage, voxel, vec4(takeUnsigned(first + SUM_ALBEDO, scale), one));
#endif
#ifdef VOLUME_NORMAL
  imageStore(normalImage, voxel, vec4(takeSigned(first + SUM_NORMAL, scale), opacity));
#endif
#ifdef VOLUME_LIGHT
  imageStore(lightImage, voxel, vec4(takeUnsigned(first + SUM_LIGHT, lightScale), one));
#endif
#ifdef VOLUME_SH_GREY
  imageStore(shGreyImage, voxel, takeLobe(first + SUM_SH_GREY, lightScale));
#endif
#ifdef VOLUME_SH_RED
  imageStore(shRedImage, voxel, takeLobe(first + SUM_SH_RED, lightScale));
  imageStore(shGreenImage, voxel, takeLobe(first + SUM_SH_GREEN, lightScale));
  imageStore(shBlueImage, voxel, takeLobe(first + SUM_SH_BLUE, lightScale));
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
