// SPDX-License-Identifier: BSD-3-Clause
// Lists pixels by their number of samples, most first: clears, counts, places, lists. Pixels of one sample are done:
// listing copies their colour. Source: Holländer 2013, section 4.3.5.
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

#if STEP == STEP_PLACE
layout(local_size_x = 1) in;
#else
layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
#endif
layout(std430, binding = kSortedListBuffer) writeonly buffer SortedList { uint sortedPixels[]; };
layout(std430, binding = kSortedHeaderBuffer) buffer SortedHeader { SampleSort header; };
layout(binding = kSampleCountsUnit) uniform usampler2D counts;
layout(binding = kSampleFirstUnit) uniform sampler2D firstColours;
layout(binding = kSampleOutImage, rgba32f) uniform writeonly image2D outImage;
uniform ivec2 pictureSizePx;

const int kBins = kMostWindowSamples + 1;
shared uint inTile[kBins], firstOfTile[kBins];

void main() {
#if STEP == STEP_PLACE
  uint listed = 0u;
  for (int count = kMostWindowSamples; count > 1; --count) {
    header.cursor[count] = listed;
    listed += header.histogram[count];
    header.histogram[count] = 0u;  // for the next frame
  }
  header.pixels = listed;
  const uint groups = (listed + uint(kSortedGroup) - 1u) / uint(kSortedGroup);
  header.groupsX = min(groups, 1024u);
  header.groupsY = (groups + 1023u) / 1024u;
  header.groupsZ = 1u;
#else
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const uint lane = gl_LocalInvocationIndex;
  if (lane < uint(kBins)) inTile[lane] = 0u;
  barrier();
  const bool inside = all(lessThan(pixel, pictureSizePx));
  const uint count = inside ? texelFetch(counts, pixel, 0).x : 0u;
  const uint place = count > 1u ? atomicAdd(inTile[count], 1u) : 0u;
  barrier();
#if STEP == STEP_COUNT
  if (lane < uint(kBins) && inTile[lane] > 0u) atomicAdd(header.histogram[lane], inTile[lane]);
#else
  if (lane < uint(kBins) && inTile[lane] > 0u) firstOfTile[lane] = atomicAdd(header.cursor[lane], inTile[lane]);
  barrier();
  if (count > 1u) sortedPixels[firstOfTile[count] + place] = uint(pixel.y * pictureSizePx.x + pixel.x);
  if (count == 1u) imageStore(outImage, pixel, vec4(texelFetch(firstColours, pixel, 0).rgb, 1.0));
#endif
#endif
}
