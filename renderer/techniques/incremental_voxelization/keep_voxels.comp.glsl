// SPDX-License-Identifier: BSD-3-Clause
// From one volume to the other, a voxel an invocation. KEEP: all that a view does not disprove (Gaitatzes 2012, listing 7.1, with
// the sign of the depth put right). Otherwise what was injected, means of normals first, replaces what is there.
#include "renderer/techniques/incremental_voxelization/voxel_textures.glsl"
#include "renderer/voxels/disproof.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kVoxelSourceUnit) uniform VOXEL_SAMPLER sources[TARGETS];
layout(binding = kVoxelTargetImage, FORMAT) uniform writeonly VOXEL_IMAGE targets[TARGETS];
uniform int cleanedView;

void main() {
  const ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (!isInGrid(voxel)) return;
  vec4 first = texelFetch(sources[0], texelOf(voxel, gridSize()), 0);
#ifdef KEEP
  const bool keeps = first.w > 0.0 && disproofByView(cleanedView, voxel) != kDisproofCleared;
  imageStore(targets[0], texelOf(voxel, gridSize()), keeps ? first : vec4(0.0));
#if TARGETS == 4
  for (int i = 1; i < TARGETS; ++i)
    imageStore(targets[i], texelOf(voxel, gridSize()), keeps ? texelFetch(sources[i], texelOf(voxel, gridSize()), 0) : vec4(0.0));
#endif
#else
  if (!(first.w > 0.0)) return;
  imageStore(targets[0], texelOf(voxel, gridSize()), first / first.w);
#if TARGETS == 4
  for (int i = 1; i < TARGETS; ++i)
    imageStore(targets[i], texelOf(voxel, gridSize()), texelFetch(sources[i], texelOf(voxel, gridSize()), 0));
#endif
#endif
}
