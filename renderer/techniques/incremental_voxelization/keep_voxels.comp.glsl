// SPDX-License-Identifier: BSD-3-Clause
// From one volume to the other, a voxel an invocation. KEEP: all that a view does not disprove (Gaitatzes 2012, listing 7.1, with
// the sign of the depth put right). Otherwise what was injected, means of normals first, replaces what is there.
#include "renderer/techniques/incremental_voxelization/voxel_textures.glsl"
#include "renderer/incremental_voxels/disproof.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kVoxelSourceUnit) uniform VOXEL_SAMPLER sources[TARGETS];
layout(binding = kVoxelTargetImage, FORMAT) uniform writeonly VOXEL_IMAGE targets[TARGETS];
uniform int cleanedView;

#if TARGETS == 4
void copyLight(ivec3 voxel, bool keeps) {
  const vec4 red = texelFetch(sources[1], texelOf(voxel, gridSize()), 0);
  const vec4 green = texelFetch(sources[2], texelOf(voxel, gridSize()), 0);
  const vec4 blue = texelFetch(sources[3], texelOf(voxel, gridSize()), 0);
  imageStore(targets[1], texelOf(voxel, gridSize()), keeps ? red : vec4(0.0));
  imageStore(targets[2], texelOf(voxel, gridSize()), keeps ? green : vec4(0.0));
  imageStore(targets[3], texelOf(voxel, gridSize()), keeps ? blue : vec4(0.0));
}
#endif

void main() {
  const ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (!isInGrid(voxel)) return;
  vec4 first = texelFetch(sources[0], texelOf(voxel, gridSize()), 0);
#ifdef KEEP
  const bool keeps = first.w > 0.0 && disproofByView(cleanedView, voxel) != kDisproofCleared;
  imageStore(targets[0], texelOf(voxel, gridSize()), keeps ? first : vec4(0.0));
#if TARGETS == 4
  copyLight(voxel, keeps);
#endif
#else
  if (!(first.w > 0.0)) return;
  imageStore(targets[0], texelOf(voxel, gridSize()), first / first.w);
#if TARGETS == 4
  copyLight(voxel, true);
#endif
#endif
}
