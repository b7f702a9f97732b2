// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of recursive refinement are bound to, beside the patches of tessellation_bindings.h. For
// C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const int kRecursionGroup = 64;

// A part of a patch's domain. std430.
struct RecursionPart {
  vec4 corners;        // rectangle: lowest and highest (u, v); triangle: (u, v) of corners 0 and 1
  float lastU, lastV;  // triangle: of corner 2
  uint patchNumber;
  uint steps;
};
#ifdef __cplusplus
static_assert(sizeof(RecursionPart) == 32 && offsetof(RecursionPart, lastU) == 16);
#endif

// std430.
struct RecursionCounters {
  uint groupsX, groupsY, groupsZ;              // of the parts in the queue
  uint diceGroupsX, diceGroupsY, diceGroupsZ;  // of finished parts
  uint queued, next;                           // parts in the queue, and in the one being filled
  uint indices, instances, firstIndex, baseVertex, baseInstance;  // DrawElementsIndirectCommand
  uint finished, leftOut, cutShort, culled, tests, rounds;
  uint unused;
};
#ifdef __cplusplus
static_assert(sizeof(RecursionCounters) == 80 && offsetof(RecursionCounters, indices) == 32);
#endif

// Splitting; patches are bound as for tessellation.
const uint kSplitCountersBuffer = 3u;
const uint kQueueBuffer = 4u;
const uint kNextQueueBuffer = 5u;
const uint kFinishedBuffer = 6u;
const uint kListedTrianglesBuffer = 7u;
// Geometry shaders: texture units, and a bit of a part's patchNumber.
const uint kPartPointsUnit = 0u;
const uint kPartPatchesUnit = 1u;
const uint kPartIsFinished = 0x80000000u;
// Dicing; vertices and indices are bound as for tessellation.
const uint kDiceCountersBuffer = 5u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
