// SPDX-License-Identifier: BSD-3-Clause
// Finds a receiver's micro-occluders and backprojects them onto the light. Schwarz 2009, sections 4.1 and 4.2.
// The including shader defines what is gathered: accumulate(low, high) for a rectangle in unit light coordinates,
// clearGathered(), isSaturated(), gatheredVisibility().
//
// In tangents t = x/z the backprojection of a texel edge at depth z from receiver p is, in unit light coordinates,
//   s = z / (p_z - z) * (p_z t - p_x) / w + 1/2.
layout(binding = 1) uniform sampler2D minimumMap;  // level 0: the linear shadow map
layout(binding = 2) uniform sampler2D maximumMap;  // its level i is the pyramid's level i + 1
uniform int levels, refinements, budgetPerAxis;
// Iterations that the driver's compiler allows a shader: llvmpipe leaves all loops silently after 65,535.
uniform int maxIterations;

void clearGathered();
void accumulate(vec2 low, vec2 high);
bool isSaturated();
float gatheredVisibility();

// Texels [low, high) of level 0.
struct Area {
  ivec2 low, high;
};

// Cut of the pyramid from the receiver to the light with the plane z, as texels; clipped to the map.
Area searchArea(vec4 p, float z, out bool reachesOutside) {
  const vec2 centre = p.xy / p.z;
  const vec2 halfSize = 0.5 * lightSize * max(1.0 / z - 1.0 / p.z, 0.0);
  const vec2 low = floor(mapTexel(centre - halfSize)), high = ceil(mapTexel(centre + halfSize));
  reachesOutside = any(lessThan(low, vec2(0.0))) || any(greaterThan(high, vec2(float(resolution))));
  const vec2 limit = vec2(float(resolution));
  return Area(ivec2(clamp(low, vec2(0.0), limit)), ivec2(clamp(high, vec2(0.0), limit)));
}

// Smallest and largest depth over an area: the finest level at which at most 2 x 2 texels cover it.
vec2 depthRange(Area area) {
  const ivec2 last = area.high - 1;
  const int extent = max(last.x - area.low.x, last.y - area.low.y);
  int level = extent > 0 ? findMSB(extent) : 0;
  if (any(greaterThan((last >> level) - (area.low >> level), ivec2(1)))) ++level;
  const ivec2 a = area.low >> level, b = last >> level;
  const float low = min(min(texelFetch(minimumMap, a, level).x, texelFetch(minimumMap, ivec2(b.x, a.y), level).x),
                        min(texelFetch(minimumMap, ivec2(a.x, b.y), level).x, texelFetch(minimumMap, b, level).x));
  float high;
  if (level == 0) {
    high = max(max(texelFetch(minimumMap, a, 0).x, texelFetch(minimumMap, ivec2(b.x, a.y), 0).x),
               max(texelFetch(minimumMap, ivec2(a.x, b.y), 0).x, texelFetch(minimumMap, b, 0).x));
  } else {
    high = max(max(texelFetch(maximumMap, a, level - 1).x, texelFetch(maximumMap, ivec2(b.x, a.y), level - 1).x),
               max(texelFetch(maximumMap, ivec2(a.x, b.y), level - 1).x, texelFetch(maximumMap, b, level - 1).x));
  }
  return vec2(low, high);
}

// Finest level at which the area's texels, rounded outward to that level's grid, keep within the budget on both axes.
int microOccluderLevel(Area area) {
  const ivec2 last = area.high - 1;
  int level = 0;
  while (level < levels - 1) {
    const ivec2 count = (last >> level) - (area.low >> level) + 1;
    if (max(count.x, count.y) <= budgetPerAxis) break;
    ++level;
  }
  return level;
}

// z / (p_z - z): how far depth z throws from the receiver onto the light. `depth` < p_z is what z has undercut.
float throwOf(float z, float pz) { return z / (pz - z); }

float visibilityOf(vec4 p, ivec2 pixel) {
  bool reachesOutside;
  // The first area is cut by the nearest surface of the whole map: conservative, and far smaller than by the near plane.
  float nearest = max(near, texelFetch(minimumMap, ivec2(0), levels - 1).x);
  fetchCount = 1u;
  pixelClass = kLit;
  if (nearest >= biasedDepth(p, 0)) return 1.0;
  Area area;
  for (int i = 0;; ++i) {
    area = searchArea(p, nearest, reachesOutside);
    if (any(greaterThanEqual(area.low, area.high))) {
      if (reachesOutside) pixelClass = kOutside;
      return 1.0;
    }
    const vec2 range = depthRange(area);
    fetchCount += 8u;
    if (range.x >= biasedDepth(p, 0)) return 1.0;
    // All texels block: neighbouring texels are taken as one surface.
    if (range.y < biasedDepth(p, 0) && !reachesOutside) {
      pixelClass = kUmbra;
      return 0.0;
    }
    if (i >= refinements || range.x <= nearest) break;
    nearest = range.x;
  }
  pixelClass = kProcessed;
  clearGathered();

  const int level = microOccluderLevel(area);
  levelUsed = uint(level);
  const ivec2 low = area.low >> level, high = (area.high - 1) >> level;
  const ivec2 count = high - low + 1;
  if (float(count.x + 1) * float(count.y) > float(maxIterations)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  const float depth = biasedDepth(p, level);
  const vec2 perTexel = tangentSize / float(resolution) * float(1 << level);
  // Unit light coordinates of edge e (in texels of the level) thrown by k: k (scale e + shift) + 1/2.
  const vec2 scale = p.z * perTexel / lightSize;
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  for (int y = low.y; y <= high.y; ++y) {
    const vec2 edgesY = scale.y * vec2(float(y), float(y + 1)) + shift.y;
#if GAP_FILL > 0
    float left = low.x > 0 ? texelFetch(minimumMap, ivec2(low.x - 1, y), level).x : kEmptyDepth;
    float lowerLeft = low.x > 0 && y > 0 ? texelFetch(minimumMap, ivec2(low.x - 1, y - 1), level).x : kEmptyDepth;
#endif
    for (int x = low.x; x <= high.x; ++x) {
      const float z = texelFetch(minimumMap, ivec2(x, y), level).x;
      ++fetchCount;
#if GAP_FILL > 0
      const float below = y > 0 ? texelFetch(minimumMap, ivec2(x, y - 1), level).x : kEmptyDepth;
      ++fetchCount;
#endif
      if (z < depth) {
        const vec2 edgesX = scale.x * vec2(float(x), float(x + 1)) + shift.x;
        const float k = throwOf(z, p.z);
        vec2 start = k * vec2(edgesX.x, edgesY.x) + 0.5;
        const vec2 end = k * vec2(edgesX.y, edgesY.y) + 0.5;
#if GAP_FILL > 0
        if (left < depth) start.x = min(start.x, throwOf(left, p.z) * edgesX.x + 0.5);
        if (below < depth) start.y = min(start.y, throwOf(below, p.z) * edgesY.x + 0.5);
#endif
#if GAP_FILL > 1
        if (lowerLeft < depth) {
          const float corner = throwOf(lowerLeft, p.z);
          start = min(start, corner * vec2(edgesX.x, edgesY.x) + 0.5);
        }
#endif
        ++occluderCount;
        // Clamped in an order that turns a NaN, were there one, into a bound.
        const vec2 a = min(max(start, vec2(0.0)), vec2(1.0)), b = min(max(end, vec2(0.0)), vec2(1.0));
        if (a.x < b.x && a.y < b.y) accumulate(a, b);
      }
#if GAP_FILL > 0
      left = z;
      lowerLeft = below;
#endif
    }
    if (isSaturated()) return 0.0;
  }
  return gatheredVisibility();
}
