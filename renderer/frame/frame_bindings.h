// SPDX-License-Identifier: BSD-3-Clause
// What the shaders that prepare a frame are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::frame {
#endif

// Light-space z of the nearest surface where a shadow map sees nothing.
const float kEmptyDepth = 1e30f;

// Scene geometry (GpuScene).
const uint kScenePositionsBuffer = 0u;
const uint kSceneIndicesBuffer = 1u;

// Vertices that move (MovedVertices).
const int kMoveGroup = 256;
const int kMostMotions = 32;
const uint kMoveRestPositionsBuffer = 0u;
const uint kMoveMotionOfBuffer = 1u;
const uint kMovePositionsBuffer = 2u;
const uint kMoveRestNormalsBuffer = 3u;
const uint kMoveNormalsBuffer = 4u;

// Surfaces (SurfaceBuffers). 6 and 7 are left to the tree of rays.
struct SurfaceMaterial {  // std430
  vec3 albedo;
  uint surface;        // kSurface...
  vec3 patternOrigin;  // relative to the anchor
  float patternFrequency;
  uint pattern;  // kPattern...
  float patternContrast;
  int patternOctaves;
  uint patchPoints;    // index of its first control point among the attributes
  vec3 mirror;         // share reflected; 0: none
  float glossRad;      // half-angle of the cone of directions that it comes from
  vec3 transmittance;  // share refracted; 0: opaque
  float refractiveIndex;
  vec3 emission;  // radiance from the front
  uint fresnel;   // 1: Schlick's rule for `mirror`
};
#ifdef __cplusplus
static_assert(sizeof(SurfaceMaterial) == 96 && offsetof(SurfaceMaterial, mirror) == 48 &&
              offsetof(SurfaceMaterial, transmittance) == 64 && offsetof(SurfaceMaterial, emission) == 80 &&
              offsetof(SurfaceMaterial, surface) == 12 && offsetof(SurfaceMaterial, patternOrigin) == 16 &&
              offsetof(SurfaceMaterial, pattern) == 32 && offsetof(SurfaceMaterial, patchPoints) == 44);
#endif
const uint kSurfaceMesh = 0u;
const uint kSurfacePatch = 1u;
const uint kSurfaceAperture = 2u;
const uint kPatternNone = 0u;
const uint kPatternChecker = 1u;
const uint kPatternNoise = 2u;
const uint kSurfaceMaterialsBuffer = 2u;
const uint kSurfaceNormalsBuffer = 3u;
const uint kSurfaceAttributesBuffer = 4u;  // of vertices; then control points of patches, 16 each
const uint kSurfaceTriangleMaterialsBuffer = 5u;

// ComputeRaster.
struct RasterQueueHeader {  // std430; then uvec2: triangle, first row of the band in its bounding box
  uint queued;
  uint padding[3];
};
#ifdef __cplusplus
static_assert(sizeof(RasterQueueHeader) == 16);
#endif
// Triangles that the GPU has listed itself.
struct RasterCount {  // std430
  uint triangles;
  uint unused0, unused1, unused2;
};
#ifdef __cplusplus
static_assert(sizeof(RasterCount) == 16);
#endif
const int kRasterGroup = 64;
const uint kSharedRasterTag = 0x80000000u;  // in a triangle's number, where two rasters share their pixels
const uint kRasterCountBuffer = 7u;
const uint kRasterDepthsBuffer = 4u;
const uint kRasterIdsBuffer = 5u;
const uint kRasterQueueBuffer = 3u;
const uint kRasterPreviousDepthUnit = 0u;
const uint kRasterRangesBuffer = 6u;
const uint kRasterDepthImage = 0u;
const uint kRasterIdsImage = 1u;

// SampleRaster. Its passes over triangles have the buffers of ComputeRaster.
struct SampleListHeader {          // std430; then the pixels
  uint pixels;                     // listed
  uint groupsX, groupsY, groupsZ;  // of an indirect dispatch over them, in groups of kRasterGroup
};
#ifdef __cplusplus
static_assert(sizeof(SampleListHeader) == 16 && offsetof(SampleListHeader, groupsX) == 4);
#endif
const uint kSampleRasterCentreIdsUnit = 1u;
const uint kSampleRasterReachUnit = 2u;
const uint kSampleRasterMarksImage = 0u;
const uint kSampleRasterReachImage = 1u;
const uint kSampleRasterListBuffer = 7u;
const uint kSampleRasterSamplesUnit = 3u;  // the driver's
// Of pixels beside other surfaces: tiles that hold any, and triangles that reach into these. The buffer of
// triangles stands in for that of ids while it is filled, and for that of ranges while it is read.
const uint kSampleRasterTilesUnit = 4u;
const uint kSampleRasterTilesImage = 2u;
const uint kSampleRasterKeptBuffer = 5u;
const uint kSampleRasterKeptTrianglesBuffer = 6u;
const uint kRasterRowInvocations = 1048576u;  // of a dispatch over triangles

// Depth peeling by the rasteriser.
const uint kPeelPreviousDepthUnit = 0u;

// Linear shadow map.
const uint kLinearDepthSourceUnit = 0u;
const uint kLinearDepthImage = 0u;

// Minimum and maximum pyramid of a shadow map: three levels in the first dispatch, which stores the map as
// well, four in each further one. That is what eight image units hold.
const int kPyramidFirstLevels = 3;
const int kPyramidNextLevels = 4;
const uint kPyramidDepthMapUnit = 0u;
const uint kPyramidBaseImage = 0u;
const uint kPyramidMinimumMapUnit = 0u;
const uint kPyramidMaximumMapUnit = 1u;
const uint kPyramidMinimum1Image = 1u;
const uint kPyramidMinimum2Image = 2u;
const uint kPyramidMinimum3Image = 3u;
const uint kPyramidMinimum4Image = 0u;
const uint kPyramidMaximum1Image = 4u;
const uint kPyramidMaximum2Image = 5u;
const uint kPyramidMaximum3Image = 6u;
const uint kPyramidMaximum4Image = 7u;

// Sampled pyramid.
const uint kSampledPyramidMapUnit = 0u;
const uint kSampledPyramidImage = 0u;

// Multi-scale shadow map: up to kMultiScaleLayers layers a dispatch; groups of kMultiScaleTile x
// kMultiScaleTile invocations make as many entries of each.
const int kMultiScaleLayers = 4;
const int kMultiScaleTile = 16;
// Maps of at most kMultiScaleLine texels a side: all layers along one axis, then along the other,
// kMultiScaleColumns at a time.
const int kMultiScaleLine = 256;
const int kMultiScaleLineLayers = 8;
const int kMultiScaleColumns = 8;
const uint kMultiScaleMinimumMapUnit = 0u;
const uint kMultiScaleMaximumMapUnit = 1u;
const uint kMultiScaleLayersUnit = 0u;
const uint kMultiScaleImage = 0u;

// Microrectangles.
const uint kMicrorectMinimumMapUnit = 0u;
const uint kMicrorectDepthsUnit = 1u;
const uint kMicrorectExtentsUnit = 2u;
const uint kMicrorectMergedImage = 0u;
const uint kMicrorectMergedUnit = 3u;
const uint kMicrorectDepthsImage = 0u;
const uint kMicrorectExtentsImage = 1u;

// Biases of texels.
const uint kSlopeBiasIdsUnit = 0u;
const uint kSlopeBiasMinimumMapUnit = 1u;
const uint kSlopeBiasImage = 0u;

// Pyramid of biases.
const uint kBiasPyramidMinimumMapUnit = 0u;
const uint kBiasPyramidBiasesUnit = 1u;
const uint kBiasPyramidImage = 0u;

// Summed-area table: a group scans kSumsLines lines in tiles of kSumsTile.
const int kSumsTile = 32;
const int kSumsLines = 8;
const uint kSumsImage = 0u;
const uint kSumsMeansBuffer = 0u;
const uint kSumsValuesImage = 0u;

// Mip levels of layers.
const uint kAverageBelowImage = 0u;
const uint kAverageAboveImage = 1u;

// Prefiltered map.
const uint kPrefilteredDepthsUnit = 0u;
const uint kPrefilteredImage = 0u;

// Occlusion slices.
const uint kSlicesBitsImage = 0u;
const uint kSlicesBitsUnit = 0u;
const uint kSlicesCoveredImage = 0u;

// G-buffer.
const uint kGBufferIdsUnit = 0u;
const uint kGBufferOutImage = 0u;
const uint kGBufferPlacesUnit = 1u;
const uint kGBufferPlanesImage = 1u;  // of the receivers

// Motion.
const uint kMotionIdsUnit = 0u;
const uint kMotionDisplacementImage = 0u;
const uint kMotionPreviousDepthImage = 1u;
const uint kMotionOfVerticesBuffer = 2u;  // 0: rests; 1 + the number of its part's motion

// Receivers from another eye point.
const uint kReceiversFromReceiversUnit = 0u;
const uint kReceiversFromNormalsUnit = 1u;
const uint kReceiversFromImage = 0u;
const uint kReceiversFromPlanesImage = 1u;

// Rays from mirrors.
const uint kMirrorRaysIdsUnit = 0u;
const uint kMirrorRaysShownBuffer = 6u;
const uint kMirrorRaysOriginsImage = 0u;
const uint kMirrorRaysDirectionsImage = 1u;
const float kTotalReflectionCosine = 2.0f;

// Shaded picture.
const uint kShadedIdsUnit = 0u;
const uint kShadedOutImage = 0u;
const uint kShadedReceiversUnit = 1u;
const uint kShadedShadowMapUnit = 2u;

#ifdef __cplusplus
}  // namespace limen::frame
#endif
