// SPDX-License-Identifier: BSD-3-Clause
// Means of a voxel's attributes from their sums.
#include "renderer/voxels/volume.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kVoxelSumsBuffer) readonly buffer Sums { uint voxelSums[]; };
#ifdef VOLUME_ALBEDO
layout(binding = kVolumeAlbedoImage, VOLUME_FORMAT) uniform writeonly image2DArray albedoImage;
#endif
#ifdef VOLUME_NORMAL
layout(binding = kVolumeNormalImage, VOLUME_FORMAT) uniform writeonly image2DArray normalImage;
#endif

void main() {
  const ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (!isInGrid(voxel)) return;
  const uint first = kVoxelSums * uint(voxel.x + gridSizeX * (voxel.y + gridSizeY * voxel.z));
  const uint entries = voxelSums[first];
  const float scale = entries > 0u ? 1.0 / (kVoxelFixed * float(entries)) : 0.0;
#ifdef VOLUME_ALBEDO
  imageStore(albedoImage, voxel,
             vec4(scale * vec3(voxelSums[first + 1u], voxelSums[first + 2u], voxelSums[first + 3u]), entries > 0u));
#endif
#ifdef VOLUME_NORMAL
  const vec3 normal = vec3(int(voxelSums[first + 4u]), int(voxelSums[first + 5u]), int(voxelSums[first + 6u]));
  imageStore(normalImage, voxel, vec4(scale * normal, scale * float(voxelSums[first + 7u])));
#endif
}
