// SPDX-License-Identifier: BSD-3-Clause
// Where a voxel is in textures: layers of an array, or tiles of an atlas.
#include "renderer/techniques/incremental_voxelization/point_raster_bindings.h"

#if LAYOUT == LAYOUT_ATLAS
#define VOXEL_SAMPLER sampler2D
#define VOXEL_IMAGE image2D
uniform int atlasColumns;
ivec2 texelOf(ivec3 voxel, ivec3 size) { return voxel.xy + size.xy * ivec2(voxel.z % atlasColumns, voxel.z / atlasColumns); }
#else
#define VOXEL_SAMPLER sampler2DArray
#define VOXEL_IMAGE image2DArray
ivec3 texelOf(ivec3 voxel, ivec3 size) { return voxel; }
#endif
