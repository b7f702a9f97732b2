// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of fragment meshes are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
using glm::uvec3;
#endif

const int kFragmentGroup = 64;

// A quad of the refined control mesh with all that its limit surface depends on. Its points, at 2^l segments
// a side: a grid from (-1, -1) to (n + 1, n + 1), of which (0, 0) to (n, n) lie on the quad; then the ring of
// (0, 0), which alone may be extraordinary or have sharp edges that do not run along the quad: by edge,
// counter-clockwise, the point along it and the one in the face that follows.
struct FragmentRecord {           // std430
  uint edges;                     // of the ring
  uint own;                       // ring edge that runs along the side y = 0
  uint flags;                     // kFragment...
  uint sectorFirst, sectorFaces;  // faces between the sharp edges around the quad's; of creases and corners
  uint material;
  uint sharpLow, sharpHigh;  // bit by ring edge
};
#ifdef __cplusplus
static_assert(sizeof(FragmentRecord) == 32);
#endif
const uint kFragmentRegular = 1u;  // the ring is that of a smooth vertex of valence 4, and not looked at
const uint kFragmentClosed = 2u;   // ring
const uint kFragmentCrease = 4u;   // rule of (0, 0)
const uint kFragmentCorner = 8u;
const uint kFragmentSharpX = 16u;  // the side y = 0, from (0, 0) along x
const uint kFragmentSharpY = 32u;
const uint kFragmentMostEdges = 60u;  // of a ring

// Of a level, where fragments stop at different ones: two DispatchIndirectCommands.
struct FragmentDispatch {  // std430
  uvec3 stepGroups;        // of the step that leads to it
  uint count;              // fragments that reach it
  uvec3 limitGroups;
  uint listed;  // counts up while they are listed
};
#ifdef __cplusplus
static_assert(sizeof(FragmentDispatch) == 32 && offsetof(FragmentDispatch, limitGroups) == 16);
#endif

const uint kFragmentsBuffer = 0u;
const uint kFragmentPointsBuffer = 1u;    // of all fragments at one level: vec4
const uint kFragmentTargetBuffer = 2u;    // at the next
const uint kFragmentLevelsBuffer = 3u;    // bits 0..: of the fragment; 4.., 8.., 12.., 16..: of sides 0 to 3
const uint kFragmentControlsBuffer = 4u;  // numbers of control vertices
const uint kFragmentListsBuffer = 4u;     // by level, fragmentCount each
const uint kFragmentDispatchesBuffer = 6u;
const uint kFragmentCountsBuffer = 5u;  // uvec2: vertices, triangles
const uint kFragmentOffsetsBuffer = 5u;
// kControlsBuffer is 6
const uint kFragmentVerticesBuffer = 7u;  // TessellatedVertex
const uint kFragmentIndicesBuffer = 7u;
const uint kFragmentTotalsBuffer = 4u;  // AdaptiveTotals

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
