// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of tessellation are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
using glm::ivec2;
using glm::ivec4;
using glm::vec2;
using glm::vec4;
#endif

const int kTessellationGroup = 64;
const int kFewPatches = 1024;  // of which one group makes counts and offsets
const int kMostSegments = 64;                  // of a side
const int kLeastLanes = 4, kMostLanes = 1024;  // invocations that share a patch

struct TessellatedPatch {  // std430
  uint firstPoint, firstNormal;
  uint shape;  // bit 0: rectangle; from bit 1 and 5: degrees along u and v; from bit 9: degree of the
               // normals, 3: 5 of a rectangle
  uint material;
  ivec4 neighbours;  // of each side: of what lies along it 8 patch + 2 side + (1: it runs the other way); -1:
                     // none
};
#ifdef __cplusplus
static_assert(sizeof(TessellatedPatch) == 32 && offsetof(TessellatedPatch, neighbours) == 16);
#endif

// Consistent factors of a patch's sides.
struct PatchFactors {  // std430
  uint segments;       // four bytes; all 0: culled
  uint first,
      second;  // of sides 0 and 1, 2 and 3: real factors in 1 / kSegmentUnit, before rounding; 16 bits each
  uint unused;
};
#ifdef __cplusplus
static_assert(sizeof(PatchFactors) == 16);
#endif

// What factors depend on besides the view, made once.
struct PatchBounds {  // std430
  vec3 low;           // box of the control points
  float weight;       // smallest
  vec3 high;
  uint finite;  // 1: all weights are positive
  vec3 second;  // rectangle: of derivatives uu, uv, vv; triangle: of its sides, or the largest tangent
                // distance
  float unused;
};
#ifdef __cplusplus
static_assert(sizeof(PatchBounds) == 48 && offsetof(PatchBounds, finite) == 28);
#endif

// Of a control point: its place and how it moves (surfaces::PatchMotion), homogeneous.
struct PointMotion {  // std430
  vec4 rest, sine, cosine;
};

// surfaces::PatchTrim.
struct PatchTrimRecord {  // std430
  vec2 low, high;
  int region;  // -1: none
  int unused0;
  ivec2 unused1;
};
#ifdef __cplusplus
static_assert(sizeof(PatchTrimRecord) == 32 && offsetof(PatchTrimRecord, region) == 16);
#endif

struct TessellatedVertex {  // std430
  vec3 position;            // relative to the anchor
  uint material;
  vec3 normal;  // unit
  uint rung;    // kRung...; of a textured surface, texture coordinates, 16 bits each
};
#ifdef __cplusplus
static_assert(sizeof(TessellatedVertex) == 32 && offsetof(TessellatedVertex, normal) == 16);
#endif

// Where a normal came from.
const uint kRungField = 0u;        // the patch's own normal field
const uint kRungTangents = 1u;     // cross product of the derivatives
const uint kRungInward = 2u;       // the same a little way inside
const uint kRungCornerPlane = 3u;  // area vector of the corners
const uint kRungNone = 4u;
const int kRungs = 5;

// What is written and drawn. std430.
struct TessellationTotals {
  uint vertices, patches;        // patches that fit
  uint laneBits, indexLaneBits;  // logarithms of the numbers of invocations that share a patch
  uint indices, instances, firstIndex, baseVertex, baseInstance;  // DrawElementsIndirectCommand
  uint overflow;                                                  // patches that do not fit
  uint neededVertices, neededIndices;
};
#ifdef __cplusplus
static_assert(sizeof(TessellationTotals) == 48 && offsetof(TessellationTotals, indices) == 16);
#endif

// DrawElementsIndirectCommand.
struct PatternCommand {  // std430
  uint indices, instances, firstIndex, firstVertex, firstInstance;
};
#ifdef __cplusplus
static_assert(sizeof(PatternCommand) == 20);
#endif

const uint kPatchesBuffer = 0u;
const uint kPatchPointsBuffer = 1u;
const uint kPatchNormalsBuffer = 2u;
const uint kPointMotionsBuffer = 2u;
const uint kOwnFactorsBuffer = 3u;  // of each patch four times 16 bits, in 1 / kSegmentUnit; 0: culled
const uint kFactorsBuffer = 4u;     // PatchFactors
const uint kPatchBoundsBuffer = 5u;
const uint kSlotCountsBuffer = 5u;
const uint kSlotOffsetsBuffer = 5u;
const uint kTotalsBuffer = 6u;
const uint kVerticesBuffer = 7u;
const uint kTriangleCountBuffer = 7u;
const uint kIndicesBuffer = 3u;
const uint kPatchTrimsBuffer = 3u;
const uint kTrimPlacesBuffer = 7u;

// Refinement patterns.
const uint kPatternCountsBuffer = 5u;
const uint kPatternOffsetsBuffer = 6u;
const uint kPatternInstancesBuffer = 7u;
const uint kPatternCommandsBuffer = 7u;
const uint kGapStripsBuffer = 5u;
const uint kEvaluatedPositionsBuffer = 5u;
const uint kEvaluatedNormalsBuffer = 6u;
const int kEvaluationTexels = 4096;  // a row of the texture in which the pixel shader evaluates vertices
const uint kGapNormalsOfOwn = 0x80000000u;  // in a strip's first word

// Picture.
const uint kSurfaceIdsUnit = 0u;
const uint kSurfaceNormalsUnit = 1u;
const uint kTrimsUnit = 0u;
const uint kResolveIdsImage = 0u;
const uint kResolveNormalsImage = 1u;
const uint kResolveVerticesBuffer = 0u;
const uint kResolveIndicesBuffer = 1u;
const uint kResolveSurfaceDepthsBuffer = 2u;
const uint kResolveSurfaceIdsBuffer = 3u;
const uint kResolveSurfaceQueueBuffer = 4u;
const uint kResolveMeshDepthsBuffer = 5u;
const uint kResolveMeshIdsBuffer = 6u;
const uint kResolveMeshQueueBuffer = 7u;
const uint kSurfacePictureImage = 0u;
// In one pass, beside scene and surfaces; of these the attributes are left out.
const uint kPictureGatheredBuffer = 4u;
const uint kPictureVerticesBuffer = 6u;
const uint kPictureIndicesBuffer = 7u;
const uint kSurfaceOfPatch = 0x80000000u;  // then its material; otherwise a triangle's number
const uint kSurfaceDarkCheck = 0x40000000u;  // with the former: on a dark check of the surface's texture

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
