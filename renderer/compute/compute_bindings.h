// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of general algorithms on the GPU are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::compute {
#endif

// PrefixSum: a group sums a tile of kScanRows rows of kScanGroup x 16 bytes.
const int kScanGroup = 256;
const int kScanRows = 4;
const int kScanWindow = 32;  // tiles that a group looks back at together
const uint kScanValuesBuffer = 0u;
const uint kScanSumsBuffer = 1u;
const uint kScanTilesBuffer = 2u;
const uint kScanStateBuffer = 3u;
const uint kScanTileNothing = 0u;
const uint kScanTileOwn = 1u;  // the tile's own sum is there
const uint kScanTileAll = 2u;  // and that of all up to it

#ifdef __cplusplus
}  // namespace limen::compute
#endif
