// SPDX-License-Identifier: BSD-3-Clause
// The window over which a prefiltered map is averaged, and what its part beyond the map adds. The technique defines
// estimate(): visibility by the averages over a rectangle within the map, for a receiver at a normalised depth.
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#define SUMS_UNIT kAveragesUnit
#include "renderer/frame/prefiltered_map.glsl"

#ifdef WINDOW_FIXED
uniform float filterRadius;  // texels
#else
uniform float searchScale;
#endif
#ifdef WINDOW_SEARCHED
#include "renderer/techniques/soft_shadows/percentage_closer.glsl"
uniform int searchTaps;  // along a side
#endif

// Where the exponentials and series take the receiver to be: never beyond the map's depths, so that only texels nearer
// than the deepest can block.
float receiverDepth(vec4 receiver) { return normalisedDepth(biasedDepth(receiver, 0)); }

float estimate(vec2 low, vec2 high, float depth);
// Light-space z of the blockers' average, or a negative number if there are none.
float blockerDepth(vec4 receiver, vec2 centre, vec2 size);

// The part of a window that lies on the map.
void cutToMap(vec2 centre, vec2 size, out vec2 low, out vec2 high) {
  low = clamp(centre - 0.5 * size, vec2(0.0), vec2(float(resolution)));
  high = clamp(centre + 0.5 * size, vec2(0.0), vec2(float(resolution)));
}

#ifdef WINDOW_SEARCHED
float blockerDepth(vec4 receiver, vec2 centre, vec2 size) {
  // As in percentage-closer soft shadows: the constant bias alone.
  const float depth = biasedDepth(receiver, 0);
  float sum = 0.0;
  int blockers = 0;
  for (int j = 0; j < searchTaps; ++j)
    for (int i = 0; i < searchTaps; ++i) {
      float z;
      if (tapBlocks(tapPlace(centre, size, i, j, searchTaps), receiver, depth, z)) {
        sum += z;
        ++blockers;
      }
    }
  fetchCount += uint(searchTaps * searchTaps);
  return blockers > 0 ? sum / float(blockers) : -1.0;
}
#endif

float visibilityOf(vec4 receiver, ivec2 pixel) {
  const vec2 centre = mapTexel(receiver.xy / receiver.z);
  const vec2 texelsPerTangent = float(resolution) / tangentSize;
#ifdef WINDOW_FIXED
  vec2 size = vec2(2.0 * filterRadius);
#else
  vec2 size = max(searchScale * lightSize * (1.0 / near - 1.0 / receiver.z) * texelsPerTangent, vec2(1.0));
#endif
  pixelClass = kOutside;
  // Written so that a NaN counts as outside.
  if (!(all(greaterThan(centre + 0.5 * size, vec2(0.0))) &&
        all(lessThan(centre - 0.5 * size, vec2(float(resolution))))))
    return 1.0;
  pixelClass = kProcessed;
#ifndef WINDOW_FIXED
  const float blocker = blockerDepth(receiver, centre, size);
  if (!(blocker > 0.0)) return 1.0;
  size = max(lightSize * (1.0 / blocker - 1.0 / receiver.z) * texelsPerTangent, vec2(1.0));
#endif
  vec2 low, high;
  cutToMap(centre, size, low, high);
  const vec2 inside = (high - low) / size;
  const float share = min(inside.x * inside.y, 1.0);  // rounding may leave a little more than all
  if (!(share > 0.0)) return 1.0;
  return 1.0 - share * (1.0 - clamp(estimate(low, high, receiverDepth(receiver)), 0.0, 1.0));
}
