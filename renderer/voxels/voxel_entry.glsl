// SPDX-License-Identifier: BSD-3-Clause
// What a triangle adds to the sums of a voxel that it enters. See VoxelAttribute.
#include "renderer/voxels/voxel_slots.glsl"
#include "renderer/voxels/voxel_surface.glsl"
#include "renderer/voxels/voxel_triangle.glsl"

#ifdef SUMS
layout(std430, binding = kVoxelSumsBuffer) buffer Sums { uint voxelSums[]; };
uniform float sumSteps, lightSteps;

#ifdef VOXEL_LIT
void addLobe(uint at, float front, float back, vec3 normal) {
  const ivec4 lobe = ivec4(round(lightSteps * entryLobe(front, back, normal)));
  atomicAdd(voxelSums[at], uint(lobe.x));
  atomicAdd(voxelSums[at + 1u], uint(lobe.y));
  atomicAdd(voxelSums[at + 2u], uint(lobe.z));
  atomicAdd(voxelSums[at + 3u], uint(lobe.w));
}
#endif

// `place`: a point of the triangle, in voxels.
void addEntry(ivec3 voxel, vec3 place, uint id, VoxelTriangle t) {
  const uint slot = slotOf(voxel);
  if (slot == kNoSlot) return;
  const uint first = SUMS * slot;
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[id]];
  const vec3 unit = t.reach > 0.0 ? normalize(t.normal / t.reach) : vec3(0.0);
  atomicAdd(voxelSums[first], 1u);
#ifdef SUM_OPACITY
  const float opacity = entryOpacity(material);
  atomicAdd(voxelSums[first + SUM_OPACITY], uint(round(sumSteps * opacity)));
#endif
  const vec3 position = gridOrigin + voxelSize * place, albedo = entryAlbedo(material, position);
#ifdef VOLUME_ALBEDO
  const uvec3 share = uvec3(round(sumSteps * albedo));
  atomicAdd(voxelSums[first + SUM_ALBEDO], share.x);
  atomicAdd(voxelSums[first + SUM_ALBEDO + 1u], share.y);
  atomicAdd(voxelSums[first + SUM_ALBEDO + 2u], share.z);
#endif
#ifdef VOLUME_NORMAL
  const ivec3 normal = ivec3(round(sumSteps * unit));
  atomicAdd(voxelSums[first + SUM_NORMAL], uint(normal.x));
  atomicAdd(voxelSums[first + SUM_NORMAL + 1u], uint(normal.y));
  atomicAdd(voxelSums[first + SUM_NORMAL + 2u], uint(normal.z));
#endif
#ifdef VOXEL_LIT
  const EntryLight light = entryLight(material, albedo, position, unit, id);
#ifdef VOLUME_LIGHT
  const uvec3 sum = uvec3(round(lightSteps * min(light.front + light.back, vec3(largestLight))));
  atomicAdd(voxelSums[first + SUM_LIGHT], sum.x);
  atomicAdd(voxelSums[first + SUM_LIGHT + 1u], sum.y);
  atomicAdd(voxelSums[first + SUM_LIGHT + 2u], sum.z);
#endif
#ifdef VOLUME_SH_GREY
  addLobe(first + SUM_SH_GREY, dot(light.front, kLuminance), dot(light.back, kLuminance), unit);
#endif
#ifdef VOLUME_SH_RED
  addLobe(first + SUM_SH_RED, light.front.x, light.back.x, unit);
  addLobe(first + SUM_SH_GREEN, light.front.y, light.back.y, unit);
  addLobe(first + SUM_SH_BLUE, light.front.z, light.back.z, unit);
#endif
#endif
}
#endif
