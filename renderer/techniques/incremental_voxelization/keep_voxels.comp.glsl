// SPDX-License-Identifier: BSD-3-Clause
// From one volume to the other, a voxel an invocation. KEEP: all that a view does not disprove (Gaitatzes 2012, listing 7.1, with
// the sign of the depth put right) and that the grid held before it moved. Otherwise what was injected, means of normals first, replaces what is there.
#include "renderer/techniques/incremental_voxelization/voxel_textures.glsl"
#include "renderer/incremental_voxels/disproof.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kVoxelSourceUnit) uniform VOXEL_SAMPLER sources[TARGETS];
layout(binding = kVoxelTargetImage, FORMAT) uniform writeonly VOXEL_IMAGE targets[TARGETS];
uniform int cleanedView;
uniform int shiftX, shiftY, shiftZ;  // by which the grid moved before this step

#if TARGETS == 4
void copyLight(ivec3 stored, bool keeps) {
  const vec4 red = texelFetch(sources[1], texelOf(stored, gridSize()), 0);
  const vec4 green = texelFetch(sources[2], texelOf(stored, gridSize()), 0);
  const vec4 blue = texelFetch(sources[3], texelOf(stored, gridSize()), 0);
  imageStore(targets[1], texelOf(stored, gridSize()), keeps ? red : vec4(0.0));
  imageStore(targets[2], texelOf(stored, gridSize()), keeps ? green : vec4(0.0));
  imageStore(targets[3], texelOf(stored, gridSize()), keeps ? blue : vec4(0.0));
}
#endif

void main() {
  const ivec3 stored = ivec3(gl_GlobalInvocationID);
  if (!isInGrid(stored)) return;
  vec4 first = texelFetch(sources[0], texelOf(stored, gridSize()), 0);
#ifdef KEEP
  const ivec3 voxel = voxelStoredAt(stored);
  const bool keeps = first.w > 0.0 && isInGrid(voxel + ivec3(shiftX, shiftY, shiftZ)) && disproofByView(cleanedView, voxel) != kDisproofCleared;
  imageStore(targets[0], texelOf(stored, gridSize()), keeps ? first : vec4(0.0));
#if TARGETS == 4
  copyLight(stored, keeps);
#endif
#else
  if (!(first.w > 0.0)) return;
  imageStore(targets[0], texelOf(stored, gridSize()), first / first.w);
#if TARGETS == 4
  copyLight(stored, true);
#endif
#endif
}
