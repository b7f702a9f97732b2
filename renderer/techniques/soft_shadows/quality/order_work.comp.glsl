// SPDX-License-Identifier: BSD-3-Clause
// Orders the list of pixels by the length of their loops over micro-occluders, the longest first, so that invocations that
// wait for one another have about the same to do. Bins are half an octave wide. Without SCATTER: counts each bin's pixels;
// with it: puts each pixel behind those of longer loops, within a bin in any order.
#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/quality/work_list.glsl"

layout(local_size_x = kWorkListGroup) in;
#if MAP_LAYERS > 1
layout(binding = kSplitSearchAreasUnit) uniform usampler2DArray searchAreas;
layout(binding = kSplitLevelMapUnit) uniform sampler2DArray levelMap;
#else
layout(binding = kSplitSearchAreasUnit) uniform usampler2D searchAreas;
layout(binding = kSplitLevelMapUnit) uniform sampler2D levelMap;
#endif

layout(std430, binding = kOrderWorkBinsBuffer) restrict buffer Bins { uint binCounts[kWorkBins], binFilled[kWorkBins]; };
#ifdef SCATTER
layout(std430, binding = kOrderWorkOrderedListBuffer) restrict writeonly buffer OrderedList { uint orderedPixels[]; };
#endif

shared uint groupCounts[kWorkBins];
#ifdef SCATTER
shared uint groupStarts[kWorkBins];
#endif

float occludersAt(uvec4 area, int level) {
  const uvec2 count = ((area.zw - 1u) >> level) - (area.xy >> level) + 1u;
  return float(count.x) * float(count.y);
}

float occludersAround(uvec4 area, float level) {
  const int finer = int(level), coarser = int(ceil(level));
  return occludersAt(area, finer) + (coarser > finer ? occludersAt(area, coarser) : 0.0);
}

uint binOf(ivec2 pixel) {
#if MAP_LAYERS > 1
  float occluders = 0.0;
  for (int layer = 0; layer < MAP_LAYERS; ++layer) {
    const float level = texelFetch(levelMap, ivec3(pixel, layer), 0).x;
    if (level >= 0.0) occluders += occludersAround(texelFetch(searchAreas, ivec3(pixel, layer), 0), level);
  }
#else
  const float occluders = occludersAround(texelFetch(searchAreas, pixel, 0), texelFetch(levelMap, pixel, 0).x);
#endif
  return uint(clamp(2.0 * log2(occluders), 0.0, float(kWorkBins - 1u)));
}

void main() {
  const uint lane = gl_LocalInvocationIndex;
  groupCounts[lane] = 0u;
  memoryBarrierShared();
  barrier();
  ivec2 pixel;
  const bool listed = listedPixel(pixel);
  uint bin = 0u, rank = 0u;
  if (listed) {
    bin = binOf(pixel);
    rank = atomicAdd(groupCounts[bin], 1u);
  }
  memoryBarrierShared();
  barrier();
  const uint count = groupCounts[lane];
#ifdef SCATTER
  uint start = 0u;
  for (uint longer = lane + 1u; longer < kWorkBins; ++longer) start += binCounts[longer];
  groupStarts[lane] = start + (count > 0u ? atomicAdd(binFilled[lane], count) : 0u);
  memoryBarrierShared();
  barrier();
  if (listed) orderedPixels[groupStarts[bin] + rank] = uint(pixel.x) | (uint(pixel.y) << 16);
#else
  if (count > 0u) atomicAdd(binCounts[lane], count);
#endif
}
