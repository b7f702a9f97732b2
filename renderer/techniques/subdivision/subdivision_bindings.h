// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of subdivision by tables are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
using glm::uvec2;
using glm::uvec4;
#endif

const int kSubdivisionGroup = 64;
const uint kSubdivisionSlots = 64u;  // surfaces::kMostSlots

// A vertex of the control mesh at rest and what moves it.
struct CageVertex {  // std430
  vec3 rest;         // relative to the anchor
  uint joint;        // of the matrices; weight 0: none
  float weight;
  float unused0, unused1, unused2;
};
#ifdef __cplusplus
static_assert(sizeof(CageVertex) == 32 && offsetof(CageVertex, weight) == 16);
#endif

// A refined vertex as one sector sees it: CompEntry and CompNormalEntry of Holländer 2013, section 2.2.2.
struct ControlEntry {        // std430
  uint firstTerm, terms;     // of StencilTerm
  uint firstAround, around;  // vertices of its fan; bit 31 of `around`: the fan is closed
};
struct StencilTerm {  // std430
  uint vertex;
  float weight;
};

struct ControlVertex {  // std430
  vec3 position;
  uint unused;
  vec3 normal;
  uint unused1;
};
#ifdef __cplusplus
static_assert(sizeof(ControlVertex) == 32 && offsetof(ControlVertex, normal) == 16);
#endif

// BFTPatch of Holländer 2013, section 2.2.3; see surfaces::TablePatch.
struct SubdivisionPatch {   // std430
  uint firstPoint, points;  // its control vertices
  uint firstWeight;         // of its table
  uint material;
  uvec4 corners;        // drawn vertices
  uvec4 edges;          // fine edges
  uvec4 edgeSources;    // 8 patch + 2 side + (1: the other way)
  uvec4 cornerSources;  // 4 patch + corner
  uint writes;  // bits 0.. sides, 4.. corners; bits 8..: the fine edge of the side is another's, and reversed
  uint unused0, unused1, unused2;
};
#ifdef __cplusplus
static_assert(sizeof(SubdivisionPatch) == 96 && offsetof(SubdivisionPatch, corners) == 16 &&
              offsetof(SubdivisionPatch, writes) == 80);
#endif

const int kMeshLanes = 32;  // invocations that share a patch in the main step in compute

// A patch as the main step in compute reads it, whose tables have rows in an order of their own: those inside
// the patch, in blocks of kMeshLanes times the rows of an invocation, each invocation's in succession; then
// those of its sides, then its corners.
struct MeshPatch {  // std430
  uint firstPoint, points;
  uint firstWeight;  // a multiple of 4
  uint unused;
};
#ifdef __cplusplus
static_assert(sizeof(MeshPatch) == 16);
#endif

// First steps.
const uint kCageRestBuffer = 0u;
const uint kCageJointsBuffer = 1u;
const uint kCagePositionsBuffer = 2u;
const uint kControlEntriesBuffer = 3u;
const uint kStencilTermsBuffer = 4u;
const uint kFansBuffer = 5u;
const uint kControlsBuffer = 6u;
const uint kCageNormalsBuffer = 7u;

// Main step.
const uint kSubdivisionPatchesBuffer = 0u;
const uint kSubdivisionPointsBuffer = 1u;
const uint kSubdivisionTablesBuffer = 2u;
const uint kSubdivisionPlacesBuffer = 3u;  // rows' places (x in the lower 16 bits), then rows of places
const uint kSubdivisionSourcesBuffer =
    3u;  // of a fine edge's or a corner's position and normal: see surfaces::TablePatch
const uint kAttributeValuesBuffer = 5u;   // vec4
const uint kFineAttributesBuffer = 4u;    // vec4 for each drawn vertex
const uint kPackedAttributesBuffer = 7u;  // texture coordinates of each, 16 bits each
const uint kFineVerticesBuffer = 4u;      // TessellatedVertex
const uint kFineIndicesBuffer = 5u;

// Of forms that draw patches one by one, texture coordinates of each row of each patch: 16 bits each, row by
// row of kPatchAttributesAcross texels. A texture, as levels of edges take all storage buffers that a stage
// has.
const uint kPatchAttributesUnit = 0u;
const int kPatchAttributesAcross = 4096;

// Levels of edges.
struct AdaptiveTotals {  // std430; a RasterCount, then a DrawElementsIndirectCommand
  uint triangles, vertices, unused0, unused1;
  uint indices, instances, firstIndex, firstVertex, firstInstance;
  uint unused2, unused3, unused4;
};
#ifdef __cplusplus
static_assert(sizeof(AdaptiveTotals) == 48 && offsetof(AdaptiveTotals, indices) == 16);
#endif
const uint kEdgeLevelsBuffer = 5u;   // one number for each fine edge
const uint kPatchCountsBuffer = 4u;  // uvec2: vertices, triangles
const uint kPatchOffsetsBuffer = 7u;
const uint kAdaptiveTotalsBuffer = 4u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
