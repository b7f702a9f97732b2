// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#include "renderer/techniques/soft_shadows/percentage_closer.glsl"

uniform int searchTaps;  // along a side
uniform float searchScale;

float visibilityOf(vec4 receiver, ivec2 pixel) {
  const vec2 centre = mapTexel(receiver.xy / receiver.z);
  const vec2 texelsPerTangent = float(resolution) / tangentSize;
  // Cut of the pyramid from the receiver to the light with the near plane.
  const vec2 searchSize = searchScale * lightSize * (1.0 / near - 1.0 / receiver.z) * texelsPerTangent;
  pixelClass = kOutside;
  const bool inside = all(greaterThanEqual(centre + 0.5 * searchSize, vec2(0.0))) &&
                      all(lessThan(centre - 0.5 * searchSize, vec2(float(resolution))));
  if (!inside) return shareBeforePlane(receiver);
  pixelClass = kProcessed;
  // The search compares as if at the receiver: a bias by the whole window would hide contacts.
  const float depth = biasedDepth(receiver, 0);
  float sum = 0.0;
  int blockers = 0;
  for (int j = 0; j < searchTaps; ++j)
    for (int i = 0; i < searchTaps; ++i) {
      float z;
      if (tapBlocks(tapPlace(centre, searchSize, i, j, searchTaps), receiver, depth, z)) {
        sum += z;
        ++blockers;
      }
    }
  fetchCount += uint(searchTaps * searchTaps);
  if (blockers == 0) return shareBeforePlane(receiver);
  const float blockerDepth = sum / float(blockers);
  const vec2 filterSize = max(lightSize * (1.0 / blockerDepth - 1.0 / receiver.z) * texelsPerTangent, vec2(1.0));
  return percentageCloser(centre, filterSize, receiver, windowDepth(receiver, filterSize));
}
