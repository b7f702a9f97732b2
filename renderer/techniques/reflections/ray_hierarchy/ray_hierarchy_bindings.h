// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of the hierarchy over rays are bound to, and the records that they exchange with C++.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

#ifndef __cplusplus
// As of C++ (cone_sphere.h).
const float kAllDirections = 1000.0;
struct ConeSphere {
  vec3 centre;
  float radius;
  vec3 axis;
  float spread;
};
#endif
const int kConeSphereBytes = 32;
const int kHierarchyLevels = 15;  // of 16384 rays a side
const int kHierarchyMostSide = 16384;

// A pair is (node, triangle); a node is its level and its place: x + 2^14 y + 2^28 level.
const int kNodeBits = 14;

const int kBuildSide = 16;  // nodes a side that a group merges: four levels a dispatch
const int kBuildLevels = 4;
const int kTraversalGroup = 128;
const uint kHierarchyNoTriangle = 0xffffffffu;
const uint kFarthestBits = 0x7f7fffffu;  // of the largest float
const uint kDispatchRow = 65535u;

const int kHierarchyMostBatches = 4096;

// Level of the regions into which a software renderer, which ends an invocation's loops after 65,535 rounds in all, divides
// what groups without room go down to. A region has 1,365 nodes of single rays; in a round of the descent eight
// invocations that run together take less than 6 rounds to go up, 4 to meet a ray, and 2 more: 1,365 x 12 = 16,380, and
// only as many for rays in larger leaves.
const uint kHierarchyRegionLevel = 5u;

struct HierarchyControl {  // std430
  uint inputs;             // pairs of the stream that is read
  uint outputs;            // pairs of all groups so far, those that found no room included
  uint limit;              // where the first group without room would have begun
  uint left;               // groups without room
  uint expandX, expandY, expandZ, previousInputs;
  uint finishX, finishY, finishZ, finishGroups;
  uint resolveX, resolveY, resolveZ, cutShort;  // cutShort: a loop that a software renderer would have left
  uint spilled, spillLimit;                     // of pairs that wait, as outputs and limit
  uint sparseItems, unused;
  // Since the frame began.
  uint leftEver, leafPairs, spilledEver, laterBatches;
  uint pairsAt[16];                       // of each level; the last: of later batches
  uint batchLeft[kHierarchyMostBatches];  // groups without room
};
#ifdef __cplusplus
static_assert(offsetof(HierarchyControl, expandX) == 16 && offsetof(HierarchyControl, finishX) == 32 &&
              offsetof(HierarchyControl, resolveX) == 48 && offsetof(HierarchyControl, pairsAt) == 96 &&
              sizeof(HierarchyControl) == 160 + 4 * kHierarchyMostBatches);
#endif

// Of cones, behind the pairs' counts of all tiles.
struct GatheredTail {  // std430
  uint gathered;       // pairs, those that found no room included
  uint cutShort;
  uint unused0, unused1;
};
const int kGatheredBytes = 12;
#ifdef __cplusplus
static_assert(sizeof(GatheredTail) == 16);
#endif

// Storage; 0 and 1 are the scene's, and where points are shaded 2 to 5 its surfaces'.
const uint kHierarchyNodesBuffer = 2u;
const uint kHierarchySpheresBuffer = 3u;
const uint kHierarchyPairsBuffer = 4u;
const uint kHierarchyControlBuffer = 5u;
const uint kHierarchyHitsBuffer = 6u;
const uint kHierarchyLeftBuffer = 7u;
// Where no triangle is looked at.
const uint kHierarchyOutBuffer = 6u;
const uint kHierarchySpillBuffer = 0u;
const uint kHierarchyReducedBuffer = 0u;
const uint kHierarchyGatheredBuffer = 0u;

// What the shader between two steps does.
const uint kControlBatch = 0u;       // a batch begins
const uint kControlStep = 1u;        // what was written is read next
const uint kControlLaterBatch = 2u;  // pairs that waited are read next

// Rays.
const uint kHierarchyOriginsUnit = 0u;
const uint kHierarchyDirectionsUnit = 1u;
const uint kHierarchyFromUnit = 2u;     // triangles that rays leave
const uint kHierarchySeenUnit = 3u;     // directions of the first rays
const uint kHierarchySeenIdsUnit = 4u;  // triangles that pixels see
const uint kHierarchyNextOriginsImage = 0u;
const uint kHierarchyNextDirectionsImage = 1u;
const uint kHierarchyNextFromImage = 2u;
const uint kHierarchySumsImage = 3u;
const uint kHierarchySharesImage = 4u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
