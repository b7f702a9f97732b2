// SPDX-License-Identifier: BSD-3-Clause
// Microrects of a level as rectangles at one depth, backprojected onto the light. Schwarz 2009, section 4.5.1; see
// renderer/frame/microrect_map.h for what they are. At level 0 they are micropatches. The including shader gathers:
// accumulate(low, high) takes a rectangle in unit light coordinates.
//
// GAP_FILL as for micropatches: a rectangle is stretched to where its lower bounds lie at the depth of the microrect before
// it.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

layout(binding = kRectDepthsUnit) uniform sampler2D rectDepths;  // its level i is level i + 1
layout(binding = kRectExtentsUnit) uniform usampler2D rectExtents;

// A microrect lies strictly between its neighbours' reference texels, so that a texel between two of these may be in
// either's.
Range occluderRange(Area area, int level) {
  return Range(area.low >> level, min(((area.high - 2) >> level) + 1, ivec2((resolution >> level) - 1)));
}

// All texels that a microrect in range may stand for, so that its depth is within their range of depths.
Area areaOfRange(Range range, int level) {
  return Area(max(((range.low - 1) << level) + 1, ivec2(0)), min((range.high + 1) << level, ivec2(resolution)));
}

float rectDepth(ivec2 at, int level) {
  ++fetchCount;
  return level == 0 ? texelFetch(minimumMap, at, 0).x : texelFetch(rectDepths, at, level - 1).x;
}

// First texel and the one after the last, of level 0.
ivec4 rectBounds(ivec2 at, int level) {
  const ivec2 reference = at << level;
  if (level == 0) return ivec4(reference, reference + 1);
  ++fetchCount;
  const ivec4 extent = ivec4(texelFetch(rectExtents, at, level - 1));
  return ivec4(reference - extent.xy, reference + extent.zw + 1);
}

// Visibility by the microrects of a level that reach into the area.
float gatherOccluders(vec4 p, Area area, int level) {
  const Range range = occluderRange(area, level);
  const ivec2 low = range.low, high = range.high;
  const ivec2 count = max(high - low + 1, ivec2(0));
  const float depth = biasedDepth(p, level);
  const vec2 perTexel = tangentSize / float(resolution);
  const vec2 scale = p.z * perTexel / lightSize;
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  int visited = 0;
  for (int y = low.y; y <= high.y; ++y) {
#if GAP_FILL != GAP_FILL_NONE
    float left = low.x > 0 ? rectDepth(ivec2(low.x - 1, y), level) : kEmptyDepth;
    float lowerLeft = low.x > 0 && y > 0 ? rectDepth(ivec2(low.x - 1, y - 1), level) : kEmptyDepth;
#endif
    for (int x = low.x; x <= high.x; ++x) {
      ++visited;
      const float z = rectDepth(ivec2(x, y), level);
      ++examinedCount;
#if GAP_FILL != GAP_FILL_NONE
      const float below = y > 0 ? rectDepth(ivec2(x, y - 1), level) : kEmptyDepth;
#endif
      if (z < depth) {
        const ivec4 bounds = rectBounds(ivec2(x, y), level);
        const vec2 lowEdge = scale * vec2(bounds.xy) + shift, highEdge = scale * vec2(bounds.zw) + shift;
        const float k = projectionScale(z, p.z);
        vec2 start = k * lowEdge + eyeOnLight;
        const vec2 end = k * highEdge + eyeOnLight;
#if GAP_FILL != GAP_FILL_NONE
        if (left < depth) start.x = min(start.x, projectionScale(left, p.z) * lowEdge.x + eyeOnLight.x);
        if (below < depth) start.y = min(start.y, projectionScale(below, p.z) * lowEdge.y + eyeOnLight.y);
#endif
#if GAP_FILL == GAP_FILL_DIAGONAL
        if (lowerLeft < depth) start = min(start, projectionScale(lowerLeft, p.z) * lowEdge + eyeOnLight);
#endif
        accumulateOnLight(start, end);
      }
#if GAP_FILL != GAP_FILL_NONE
      left = z;
      lowerLeft = below;
#endif
    }
    if (isSaturated()) return 0.0;
  }
  // A driver that grants a limited number of iterations has left the loops early.
  if (visited < count.x * count.y) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  return gatheredVisibility();
}
