// SPDX-License-Identifier: BSD-3-Clause
// What the shaders are bound to that fill voxels from depth images. For C++ and GLSL. Storage buffers 0 to 5
// are left to the scene and its surfaces, texture units from 12 on to the volume.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::incremental_voxels {
#endif

// Depth images: the camera's, then the light's, each with one unit for depths and one for triangles.
const int kMostDepthViews = 2;
const uint kViewDepthsUnit = 0u;
const uint kViewTrianglesUnit = 2u;
const uint kViewTilesUnit = 4u;  // least and largest depth of each tile, kDepthTile px a side
const int kDepthTile = 8;
const uint kDepthTilesImage = 0u;

// A brick is what one work group cleans up: words of 32 voxels along x, 8 x 8 of them.
const int kBrickSide = 8;
const int kBrickWords = 64;
const int kBrickLanes = 256;  // of its group
const int kSampleGroup = 64;

const uint kSampledBitsImage = 0u;    // as kVoxelBitsImage
const uint kSampledNormalImage = 3u;  // rgba16f
const uint kSampledAlbedoImage = 4u;
const uint kSampledLightImage = 5u;

// Sums of the samples in a touched voxel: their number; normal (3, signed), albedo (3); then for each view
// the number of its samples and their light (3).
const uint kSampleWords = 7u;
const uint kSampleViewWords = 4u;
const uint kSampleSumsBuffer = 6u;
const uint kSampleStateBuffer = 7u;

struct SampleCounts {  // std430; of one step
  uint kept, cleared;  // voxels of the step before
  uint added;          // that were empty
  uint touched;        // voxels with samples
  uint samples;        // within the grid
  uint tested;         // bricks
  uint padding0, padding1;
};
// The state's buffer: two of these, used in turn; then the keys of a hash table of touched voxels, 0 where a
// place is free: this bit, and 10 bits each of where the voxel is stored.
const uint kSampleKey = 0x80000000u;
#ifdef __cplusplus
static_assert(sizeof(SampleCounts) == 32);
#endif

// Pixels along an axis that are looked at of a voxel's footprint, less one.
const int kFootprintSteps = 3;

// Rounding of a sample's place, in voxels: it is moved this far beyond the surface that it lies on, so that a
// surface between two voxels is in the one behind it, whoever sees it from there.
const float kSampleNudge = 0.0009765625f;

#ifdef __cplusplus
}  // namespace limen::incremental_voxels
#endif
