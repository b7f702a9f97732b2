// SPDX-License-Identifier: BSD-3-Clause
// Shades samples of each pixel and averages them, in the order of the window, so that every form gives the same picture
// to the last bit. Source: Holländer 2013, sections 4.3.2 and 4.3.5.
#include "renderer/techniques/antialiasing/sample_colour.glsl"

#if FORM == FORM_SORTED
layout(local_size_x = kSortedGroup) in;
layout(std430, binding = kSortedListBuffer) readonly buffer SortedList { uint sortedPixels[]; };
layout(std430, binding = kSortedHeaderBuffer) readonly buffer SortedHeader { SampleSort header; };
#else
layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
#endif
layout(binding = kSampleFirstUnit) uniform sampler2D firstColours;
layout(binding = kSampleCountsUnit) uniform usampler2D counts;
layout(binding = kSampleOutImage, rgba32f) uniform writeonly image2D outImage;

uniform ivec2 pictureSizePx;
uniform int group;  // grouped: the number of samples of the pixels in turn

// The mean of `count` samples, the first of which is known.
vec3 meanColour(ivec2 pixel, vec3 first, int count) {
  precise vec3 sum = first;
  for (int n = 1; n < count; ++n) sum += sampleColour(WINDOW * pixel + kOrder[n], count);
  precise const vec3 mean = sum / float(count);
  return mean;
}

void main() {
#if FORM == FORM_SORTED
  const uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kSortedGroup) +
                     gl_LocalInvocationIndex;
  if (index >= header.pixels) return;
  const ivec2 pixel = ivec2(sortedPixels[index] % uint(pictureSizePx.x), sortedPixels[index] / uint(pictureSizePx.x));
#else
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, pictureSizePx))) return;
#endif
#if FORM == FORM_FIRST
  const vec3 colour = sampleColour(WINDOW * pixel + kOrder[0], 1);
#elif FORM == FORM_FULL
  const vec3 colour = meanColour(pixel, sampleColour(WINDOW * pixel + kOrder[0], kSamples), kSamples);
#else
  const int count = int(texelFetch(counts, pixel, 0).x);
#if FORM == FORM_GROUPED
  if (count != group) return;
#endif
  const vec3 colour = meanColour(pixel, texelFetch(firstColours, pixel, 0).rgb, count);
#endif
  imageStore(outImage, pixel, vec4(colour, 1.0));
}
