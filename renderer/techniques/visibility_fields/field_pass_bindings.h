// SPDX-License-Identifier: BSD-3-Clause
// What shaders of visibility fields are bound to. For C++ and GLSL. Storage buffers 2 to 4 are
// the fields' (field_bindings.h), 6 and 7 those of the tree of rays.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kFieldPositionUnit = 0u;
const uint kFieldNormalUnit = 1u;
const uint kFieldIdsUnit = 2u;
const uint kFieldReceiversUnit = 3u;
const uint kFieldUnfilteredUnit = 4u;
const uint kFieldOutImage = 1u;

// Reflections: rays of a pixel are layers.
const uint kLobeOriginsUnit = 0u;
const uint kLobeMirroredUnit = 1u;
const uint kLobeIdsUnit = 2u;
const uint kLobeDirectionsUnit = 3u;  // sampler2DArray
const uint kLobeHitsUnit = 4u;        // usampler2DArray
const uint kLobeNormalsUnit = 5u;
const uint kLobeOriginsImage = 1u;
const uint kLobeMirroredImage = 2u;
const uint kLobeNormalsImage = 3u;
const uint kLobeDirectionsImage = 4u;
const uint kLobeHitsImage = 5u;
const uint kLobeReflectedImage = 6u;

const uint kVertexValuesBuffer = 2u;  // float a vertex of the scene, techniques of vertices

const uint kFieldCountsBuffer = 5u;  // kFieldCountSlots numbers of look-ups
const int kFieldCountSlots = 64;

// Receivers near an object, whose rays are traced (NearReceivers).
const uint kNearListBuffer = 1u;   // NearListHeader, then words: x + 65536 y of a pixel each
const int kNearGroup = 64;         // invocations that share a pixel's rays
struct NearListHeader {            // std430
  uint pixels;                     // of the list that is being written; 0 between frames
  uint groupsX, groupsY, groupsZ;  // of an indirect dispatch, one for each pixel listed
  uint listed;
};

// Rays about which fields are in doubt, which are traced one by one (DoubtfulRays).
const uint kDoubtListBuffer = 1u;  // DoubtListHeader, then words: number of a ray among those of all pixels
// Two words a pixel, in kDoubtUnit: what its doubtful rays see, traced; looked up.
const uint kDoubtSumsBuffer = 0u;
const int kDoubtGroup = 64;
const float kDoubtUnit = 1048576.0;  // of a ray that sees all; sums of 1024 rays stay below kDoubtCutShort
const uint kDoubtCutShort = 0x80000000u;  // in a sum: some ray was cut short
struct DoubtListHeader {                  // std430
  uint rays;                              // of the list that is being written; 0 between frames
  uint groupsX, groupsY, groupsZ;         // of an indirect dispatch, for the rays listed
  uint listed;                            // 0 if there were more than fit
  uint found;
  uint overflow;  // 1: there were more than fit
  uint most;      // found in any frame since the list was made
};

const int kFalloffBinary = 0;
const int kFalloffLinear = 1;
const int kFalloffExponential = 2;
const int kLightRectangle = 0;
const int kLightSphere = 1;
const int kCombineNearest = 0;
const int kCombineProduct = 1;
const int kCombineSubtract = 2;
const int kCombinePasses = 3;
const int kFetchNearest = 0;
const int kFetchAimed = 1;
const int kFetchPositions = 2;
const int kFetchAll = 3;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
