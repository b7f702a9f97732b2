// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of stream reduction are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::compute {
#endif

// An item is invalid if its first word is this, unless a stream of flags says which are valid.
const uint kInvalidItem = 0xffffffffu;

// How many items a reduction kept, on the GPU. std430.
struct ReducedCount {
  uint valid;    // items that were kept or, for want of room, lost
  uint written;  // items in the output
  uint lost;     // valid - written
  uint spare;
  uint groupsX, groupsY, groupsZ;  // work groups over the items written, for an indirect dispatch
  uint spare2;
};
#ifdef __cplusplus
static_assert(sizeof(ReducedCount) == 32 && offsetof(ReducedCount, groupsX) == 16);
#endif

const uint kReductionItemsBuffer = 0u;
const uint kReductionFlagsBuffer = 1u;
const uint kReductionOutBuffer = 2u;
const uint kReductionStateBuffer = 3u;    // of the form: sums of tiles or blocks
const uint kReductionCountInBuffer = 4u;  // where the number of items is, if the GPU alone knows it
const uint kReductionCountBuffer = 5u;    // ReducedCount

const uint kReductionSumsBuffer = 6u;     // invalid items up to each, or sums over blocks
const uint kReductionFetchesBuffer = 7u;  // where fetches of searches are counted
const int kBlockGroup = 128;              // invocations that take a block or a place each
const int kLongestBlock = 512;

// Stages that have no storage buffers read buffer textures.
const uint kReductionItemsUnit = 0u;
const uint kReductionFlagsUnit = 1u;
const uint kReductionSumsUnit = 1u;
const uint kReductionCountUnit = 2u;

// Bucket sort: a group takes so many rows of so many items.
const int kReductionGroup = 256;
const int kReductionRows = 4;
// A tile's state: a count in the low bits.
const uint kReductionNothing = 0u;
const uint kReductionOwn = 0x40000000u;  // the tile's own count
const uint kReductionAll = 0x80000000u;  // of all tiles up to it
const uint kReductionCountMask = 0x3fffffffu;
// scan.h.
const int kScanStepGroup = 256;
const uint kScanInBuffer = 0u;
const uint kScanOutBuffer = 1u;
const uint kScanFromBuffer = 2u;
const uint kScanToBuffer = 3u;
// Words before the tiles' states.
const uint kReductionFinished = 0u;
const uint kReductionTotal = 1u;
const uint kReductionStarted = 2u;  // groups of LOOK_BACK, in dispatches that take turns
const uint kReductionStartedOdd = 3u;
const uint kReductionTiles = 4u;

#ifdef __cplusplus
}  // namespace limen::compute
#endif
