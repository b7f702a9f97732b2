// SPDX-License-Identifier: BSD-3-Clause
// Histogram of the map's next bits, among the values that have the bits found so far; in the first round also the
// counts and the largest value.
#include "perception/metrics/jnd/statistics.glsl"

layout(local_size_x = kCountGroup, local_size_y = kCountGroup) in;
layout(binding = kCountJndUnit) uniform sampler2D jnd;
layout(binding = kCountEvaluatedUnit) uniform sampler2D evaluated;
uniform ivec2 sizePx;

shared uint bins[kJndBins];
shared uint evaluatedPx, visiblePx, largestBits;

void main() {
  const uint self = gl_LocalInvocationIndex;
  const uint group = uint(kCountGroup * kCountGroup);
  for (uint bin = self; bin < uint(kJndBins); bin += group) bins[bin] = 0u;
  if (self == 0u) evaluatedPx = 0u, visiblePx = 0u, largestBits = 0u;
  barrier();
  uint counted = 0u, visible = 0u, largest = 0u;
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * kCountTile + ivec2(gl_LocalInvocationID.xy);
  for (int y = 0; y < kCountTile; y += kCountGroup)
    for (int x = 0; x < kCountTile; x += kCountGroup) {
      const ivec2 pixel = corner + ivec2(x, y);
      if (any(greaterThanEqual(pixel, sizePx))) continue;
      if (texelFetch(evaluated, pixel, 0).x < 0.5) continue;
      const float value = max(texelFetch(jnd, pixel, 0).x, 0.0);
      const uint bits = floatBitsToUint(value);
      if (round_ == 0) {
        atomicAdd(bins[bits >> 20], 1u);
        ++counted;
        if (value >= 1.0) ++visible;
        largest = max(largest, bits);
      } else {
        const uint known = round_ == 1 ? 20u : 10u, next = round_ == 1 ? 10u : 0u;
        for (int rank = 0; rank < kJndRanks; ++rank)
          if (bits >> known == statistics.valueBits[rank] >> known)
            atomicAdd(bins[uint(rank * (kJndBins / kJndRanks)) + (bits >> next & 1023u)], 1u);
      }
    }
  if (round_ == 0 && counted > 0u) {
    atomicAdd(evaluatedPx, counted);
    atomicAdd(visiblePx, visible);
    atomicMax(largestBits, largest);
  }
  barrier();
  for (uint bin = self; bin < uint(kJndBins); bin += group)
    if (bins[bin] != 0u) atomicAdd(histogram[bin], bins[bin]);
  if (round_ == 0 && self == 0u && evaluatedPx > 0u) {
    atomicAdd(statistics.evaluatedPx, evaluatedPx);
    atomicAdd(statistics.visiblePx, visiblePx);
    atomicMax(statistics.largestBits, largestBits);
  }
}
