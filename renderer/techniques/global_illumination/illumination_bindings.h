// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of global illumination are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Paths.
const uint kPathIdsUnit = 0u;
const uint kPathSumsImage = 0u;
const uint kPathSumsUnit = 0u;
const uint kPathPictureImage = 0u;

// Pictures of indirect light.
const uint kIndirectIdsUnit = 0u;
const uint kIndirectPictureImage = 0u;

// Light in voxels. Fields are arrays of 3 channels of as many layers as the grid has. Units 12 to 14 are the volume's, storage
// buffers 0 to 7 the scene's and its tree's.
struct InjectCounts {  // std430
  uint homeless;       // samples of surfaces that have no empty voxel near
};
#ifdef __cplusplus
static_assert(sizeof(InjectCounts) == 4);
#endif
const float kInjectFixed = 65536.0f;  // units of a sum of lobes: signed 32 bits hold fluxes up to 32768
const uint kInjectSamplesUnit = 0u;
const uint kInjectSumsImage = 0u;
const uint kInjectCountsBuffer = 8u;
const int kPropagateGroup = 4;
const uint kPropagateFieldUnit = 0u;
const uint kPropagateSourceUnit = 1u;
const uint kShareTableUnit = 2u;
const uint kLightCellsUnit = 3u;
const uint kPropagateOutImage = 1u;
const uint kSeedFieldImage = 2u;
const uint kLightCellsImage = 1u;
// Bits of a voxel's word (voxel_propagation/light_cells.glsl); the first two: of face 0, the others follow.
const int kCellBesideSurface = 0;  // the voxel beyond the face is occupied
const int kCellBesideLight = 6;    // it may hold light
const int kCellSurface = 12;
const int kCellLight = 13;
const int kCellEdge = 14;  // surfaces of several directions: an edge, a thin wall
const uint kPropagateChangesBuffer = 8u;
const uint kPropagateSumImage = 2u;
const uint kReflectedImage = 2u;
const uint kStepStuckBuffer = 8u;
const uint kStepLightsBuffer = 9u;
const int kLightFluxGroup = 64;
const uint kLightFluxBuffer = 8u;
const int kReflectiveRayGroup = 64;
const uint kArriveFacesImage = 0u;
const uint kReconstructArrivedUnit = 1u;
// Pixels whose light takes rays to find, and these rays (voxel_propagation/seen_light.h).
const uint kAskedRaysBuffer = 8u;     // AskedHeader, then rays: number of the pixel << kAskedCornerBits | 8 * face + corner
const uint kAskedPixelsBuffer = 9u;   // numbers of the pixels with rays; of those that search, from the picture's number of pixels on
const uint kSeenCornersBuffer = 10u;  // two words a pixel: bits 8 * face + corner of those seen
const int kAskedGroup = 64;
const int kAskedCornerBits = 6;
const uint kNoRay = 0xffffffffu;
const uint kNotTraced = 0x80000000u;     // beside a pixel's number: its rays did not fit into the list
const uint kSeenCutShort = 0x80000000u;  // in the second word: a ray was cut short
struct AskedList {                       // std430
  uint count;                      // while it is written; 0 between frames
  uint groupsX, groupsY, groupsZ;  // of an indirect dispatch
  uint listed;
};
struct AskedHeader {
  AskedList rays, pixels, searches;
};
// Pyramid of voxels' radiance: sums of a voxel, of each face its area and three channels; six faces' textures and images.
const uint kFaceSums = 24u;
const uint kFaceSumsBuffer = 8u;
const uint kRadianceUnit = 2u;
const uint kRadianceFacesImage = 1u;
const int kMostConeSteps = 64;
// Table of shares (voxel_propagation/lobe_shares.h): texels along x and y, focuses along z for each face.
const int kShareSide = 16;
const int kShareLevels = 16;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
