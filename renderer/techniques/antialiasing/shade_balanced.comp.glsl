// SPDX-License-Identifier: BSD-3-Clause
// Shades the further samples of a tile's pixels from one list of pixels and samples, so that all invocations have the
// same share of them whatever their pixels need, and averages as shade_samples.comp.glsl does. Source: the bench's own
// answer to Holländer 2013, section 4.3.7, which names divergence as the limit and tiles as the way on.
#include "renderer/techniques/antialiasing/sample_colour.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampleFirstUnit) uniform sampler2D firstColours;
layout(binding = kSampleCountsUnit) uniform usampler2D counts;
layout(binding = kSampleOutImage, rgba32f) uniform writeonly image2D outImage;

uniform ivec2 pictureSizePx;

const int kPixels = kGroupSide * kGroupSide;
shared uint ends[kPixels];  // of each pixel's part of the list
shared vec3 colours[kPixels * (kSamples - 1)];

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * kGroupSide, pixel = corner + ivec2(gl_LocalInvocationID.xy);
  const bool inside = all(lessThan(pixel, pictureSizePx));
  const uint count = inside ? texelFetch(counts, pixel, 0).x : 1u;
  ends[lane] = count - 1u;
  barrier();
  for (uint step = 1u; step < uint(kPixels); step *= 2u) {
    const uint before = lane >= step ? ends[lane - step] : 0u;
    barrier();
    ends[lane] += before;
    barrier();
  }
  const uint total = ends[kPixels - 1];
  for (uint item = lane; item < total; item += uint(kPixels)) {
    // The first pixel whose part ends beyond the item.
    uint owner = 0u;
    for (uint step = uint(kPixels) / 2u; step > 0u; step /= 2u)
      if (ends[owner + step - 1u] <= item) owner += step;
    const uint before = owner > 0u ? ends[owner - 1u] : 0u, n = item - before + 1u;
    const ivec2 at = corner + ivec2(owner % uint(kGroupSide), owner / uint(kGroupSide));
    colours[item] = sampleColour(WINDOW * at + kOrder[n], int(ends[owner] - before) + 1);
  }
  barrier();
  if (!inside) return;
  precise vec3 sum = texelFetch(firstColours, pixel, 0).rgb;
  for (uint item = ends[lane] + 1u - count; item < ends[lane]; ++item) sum += colours[item];
  precise const vec3 mean = sum / float(count);
  imageStore(outImage, pixel, vec4(mean, 1.0));
}
