// SPDX-License-Identifier: BSD-3-Clause
// Where what is stored at a place of the grid is in textures: layers of an array, or tiles of an atlas.
#include "renderer/techniques/incremental_voxelization/point_raster_bindings.h"

#if LAYOUT == LAYOUT_ATLAS
#define VOXEL_SAMPLER sampler2D
#define VOXEL_IMAGE image2D
uniform int atlasColumns;
ivec2 texelOf(ivec3 stored, ivec3 size) { return stored.xy + size.xy * ivec2(stored.z % atlasColumns, stored.z / atlasColumns); }
#else
#define VOXEL_SAMPLER sampler2DArray
#define VOXEL_IMAGE image2DArray
ivec3 texelOf(ivec3 stored, ivec3 size) { return stored; }
#endif
