// SPDX-License-Identifier: BSD-3-Clause
// Rectangles of views that are rasterised together (REGIONS of compute_raster.comp.glsl). For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::frame {
using glm::ivec2;
#endif

struct RasterRegion {  // std140
  ivec2 low, high;     // pixels, high excluded
  int at;              // first word of its results
  int unused0, unused1, unused2;
};
#ifdef __cplusplus
static_assert(sizeof(RasterRegion) == 32 && offsetof(RasterRegion, high) == 8 &&
              offsetof(RasterRegion, at) == 16);
#endif
const int kMostRasterRegions = 104;
const uint kRasterRegionsBlock = 1u;
const uint kRegionImportDepthUnit = 0u;
const uint kRegionImportIdsUnit = 1u;

#ifdef __cplusplus
}  // namespace limen::frame
#endif
