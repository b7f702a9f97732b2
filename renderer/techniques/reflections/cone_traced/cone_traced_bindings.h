// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of cone tracing are bound to. For C++ and GLSL. Storage buffers 0 to 5 belong to the scene
// and its surfaces.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const int kConeGroup = 128;

// Cones of pixels.
const uint kConeRayOriginsUnit = 0u;
const uint kConeRayDirectionsUnit = 1u;
const uint kConeIdsUnit = 2u;
const uint kConeSolidAnglesUnit = 3u;
const uint kConeOriginsImage = 0u;
const uint kConeDirectionsImage = 1u;
const uint kConeShapesImage = 2u;

// What became of a pixel's cone.
const int kConeNone = 0;
const int kConeDiverging = 1;
const int kConeConverging = 2;  // to an apex in front of the mirror, or at infinity
const int kConeClamped = 3;     // too wide for a plane

// Lists of the tiles' triangles.
const uint kConeGatheredBuffer = 0u;
const uint kConeSumsBuffer = 1u;
const uint kConeTilesBuffer = 6u;  // as the traversal leaves them
const uint kConeListsBuffer = 7u;  // first triangle and number of each tile; then triangles
const uint kConeUnlisted = 0xffffffffu;
const uint kConeRoundsBuffer = 2u;  // indirect dispatches of the composition: three numbers for each round

// Entries of a list that a dispatch of the composition looks at on a software renderer, which ends an
// invocation's loops after 65,535 rounds in all. An entry takes at most 26 rounds of clipping and overlap, 20
// of the heap, 16 octaves of a pattern and one of its own: 24,192 for 384 of them. Loading, storing and
// sorting 256 kept triangles and composing them takes 2 x 256 + 256 x 10 + 256 x (26 + 5 + 64 + 16) = 31,488
// more.
const uint kConeEntriesPerRound = 384u;

// Composition.
const uint kConeSpheresBuffer = 6u;
const uint kConeOriginsUnit = 0u;
const uint kConeDirectionsUnit = 1u;
const uint kConeShapesUnit = 3u;
const uint kConeTableUnit = 4u;
const uint kConeMaskUnit = 5u;
const uint kConeEnvironmentUnit = 6u;
const uint kConeImage = 0u;
const uint kConeCountsImage = 1u;
const uint kConeStateImage =
    4u;  // between rounds: two layers of numbers, then one for each triangle that may be kept
const int kConeMaskPoints = 64;

// Peeling.
const int kPeelItemsAcross = 4096;
const uint kPeelCounter = 0u;
const uint kPeelKeysImage = 2u;
const uint kPeelColoursImage = 3u;
const uint kPeelResultImage = 0u;
const uint kPeelKeysUnit = 0u;
const uint kPeelColoursUnit = 1u;
const uint kPeelPreviousUnit = 2u;
const uint kPeelLayerUnit = 3u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
