// SPDX-License-Identifier: BSD-3-Clause
// A rectangle of a picture by the driver's rasteriser, into the words of a region. See region_raster.h.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/raster_regions.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std140, binding = kRasterRegionsBlock) uniform Regions { RasterRegion regions[kMostRasterRegions]; };
layout(binding = kRegionImportDepthUnit) uniform sampler2D depthImage;
#if REGIONS == 2
layout(binding = kRegionImportIdsUnit) uniform usampler2D triangleIds;
#endif
layout(std430, binding = kRasterDepthsBuffer) writeonly buffer Words { uint words[]; };
uniform int regionIndex;

void main() {
  const RasterRegion region = regions[regionIndex];
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = region.high - region.low;
  if (any(greaterThanEqual(at, size))) return;
  const int place = region.at + REGIONS * (at.y * size.x + at.x);
  words[place] = floatBitsToUint(texelFetch(depthImage, region.low + at, 0).x);
#if REGIONS == 2
  words[place + 1] = ~texelFetch(triangleIds, region.low + at, 0).x;
#endif
}
