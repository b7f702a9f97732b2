// SPDX-License-Identifier: BSD-3-Clause
// Microrects of a level as rectangles at one depth, backprojected onto the light. Schwarz 2009, section 4.5.1; see
// renderer/frame/microrect_map.h for what they are. At level 0 they are micropatches. The including shader gathers:
// accumulate(low, high) takes a rectangle in unit light coordinates.
//
// GAP_FILL as for micropatches: a rectangle is stretched to where its lower bounds lie at the depth of the microrect before
// it.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

// Their level i is level i + 1.
#if MAP_LAYERS > 1
layout(binding = kRectDepthsUnit) uniform sampler2DArray rectDepths;
layout(binding = kRectExtentsUnit) uniform usampler2DArray rectExtents;
ivec3 rectPlace(ivec2 at) { return ivec3(at, mapLayer); }
#else
layout(binding = kRectDepthsUnit) uniform sampler2D rectDepths;
layout(binding = kRectExtentsUnit) uniform usampler2D rectExtents;
ivec2 rectPlace(ivec2 at) { return at; }
#endif

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
  return level == 0 ? minimumDepth(at, 0) : texelFetch(rectDepths, rectPlace(at), level - 1).x;
}

// First texel and the one after the last, of level 0.
ivec4 rectBounds(ivec2 at, int level) {
  const ivec2 reference = at << level;
  if (level == 0) return ivec4(reference, reference + 1);
  ++fetchCount;
  const ivec4 extent = ivec4(texelFetch(rectExtents, rectPlace(at), level - 1));
  return ivec4(reference - extent.xy, reference + extent.zw + 1);
}

#ifdef BIAS_STORED
// Bias of a microrect: those of the level's texels that it reaches into, folded as those of a level are (bias_map.h). A texel's
// surface spans [depth - height, depth + bias]; where that meets what the microrect stands for already, it stands for all of it.
float rectBias(float z, ivec2 at, int level) {
  const ivec4 bounds = rectBounds(at, level);
  const ivec2 first = bounds.xy >> level, last = (bounds.zw - 1) >> level;
  float found = 0.0;
  // A second time, since one texel may bring another within reach.
  for (int i = 0; i < 2; ++i)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const float depth = minimumDepth(ivec2(x, y), level);
        const vec2 spread = texelFetch(texelBiases, ivec2(x, y), level).xy;
        fetchCount += 2u;
        if (depth - spread.y <= z + found + bias * z) found = max(found, depth + spread.x - z);
      }
  return found;
}
#endif

// Whether depth z of a microrect blocks the receiver; it was found anywhere within the microrect.
bool rectBlocks(float z, ivec2 at, int level, vec4 p, float depth) {
#ifdef BIAS_PLANE
  if (!(z < depth)) return false;
  const vec4 bounds = vec4(rectBounds(at, level));
  const vec2 spread = 0.5 * (bounds.zw - bounds.xy - 1.0);
  return beforePlane(z, 0.5 * (bounds.xy + bounds.zw), p, p.z * (1.0 - planeMargin(slopeBias + max(spread.x, spread.y))));
#elif defined(BIAS_STORED)
  return z < depth && z + storedScale * rectBias(z, at, level) < depth;
#else
  return z < depth;
#endif
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
  for (int y = low.y + firstRow; y <= high.y; y += rowStep) {
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
      if (rectBlocks(z, ivec2(x, y), level, p, depth)) {
        const ivec4 bounds = rectBounds(ivec2(x, y), level);
        const vec2 lowEdge = scale * vec2(bounds.xy) + shift, highEdge = scale * vec2(bounds.zw) + shift;
        const float k = projectionScale(z, p.z);
        vec2 start = k * lowEdge + eyeOnLight;
        const vec2 end = k * highEdge + eyeOnLight;
#if GAP_FILL != GAP_FILL_NONE
        if (rectBlocks(left, ivec2(x - 1, y), level, p, depth))
          start.x = stretchedTo(start.x, projectionScale(left, p.z) * lowEdge.x + eyeOnLight.x);
        if (rectBlocks(below, ivec2(x, y - 1), level, p, depth))
          start.y = stretchedTo(start.y, projectionScale(below, p.z) * lowEdge.y + eyeOnLight.y);
#endif
#if GAP_FILL == GAP_FILL_DIAGONAL
        if (rectBlocks(lowerLeft, ivec2(x - 1, y - 1), level, p, depth)) start = min(start, projectionScale(lowerLeft, p.z) * lowEdge + eyeOnLight);
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
  if (visited < count.x * rowsToGather(count.y)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  return gatheredVisibility();
}
