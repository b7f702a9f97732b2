// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of vertex reflection are bound to. For C++ and GLSL. Storage buffers 0 to 5 belong to the
// scene and its surfaces wherever something is shaded.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kReflectorMapUnit = 0u;
const uint kReflectorBacksUnit = 1u;  // depth of the reflectors' back faces
const uint kReflectorIdsUnit = 2u;    // triangles that pixels see
const uint kFarDirectionsUnit = 3u;   // of mirrored rays
const uint kFarEnvironmentUnit = 4u;
const uint kReflectorPresentUnit = 5u;  // of open mirrors: where they are
const uint kFarImage = 0u;

// Of a vertex of the reflected mesh: reflection point relative to the scene's anchor, and the status.
const uint kReflectedVerticesBuffer = 6u;   // vec4
const uint kReflectedSourcesBuffer = 7u;    // for each triangle of the reflected mesh that of the scene
const uint kReflectedPositionsBuffer = 0u;  // where nothing is shaded
const uint kReflectionCountsBuffer = 1u;

// Status of a vertex: iterations in bits 0 to 7, exchanged samples in 8 to 15, outcome in 16 to 18 in the
// order of reflections::Outcome, 19: restarted, 20: has a point.
const uint kStatusOutcomeShift = 16u;
const uint kStatusRestarted = 1u << 19;
const uint kStatusUsable = 1u << 20;
const uint kOutcomeFound = 0u;
const uint kOutcomeUnconverged = 1u;
const uint kOutcomeFalseRoot = 2u;
const uint kOutcomeFacingAway = 3u;
const uint kOutcomeNoSurface = 4u;

// Vertices that the tessellator made.
struct ReflectionCounts {  // std430
  uint evaluated, iterations, found, unused;
};
#ifdef __cplusplus
static_assert(sizeof(ReflectionCounts) == 16);
#endif
const int kVertexGroup = 64;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
