// SPDX-License-Identifier: BSD-3-Clause
// Finds the texels of the shadow map that can matter for a receiver, and has them gathered. Schwarz 2009, sections 4.1 and
// 4.2. The including shader defines what is gathered: clearGathered(), isSaturated(), gatheredVisibility(), and what the
// file of occluders asks for.
// OCCLUDERS: 0 micropatches, 1 microquads, 2 microquads and microtris, 3 contours.
layout(binding = 1) uniform sampler2D minimumMap;  // level 0: the linear shadow map
layout(binding = 2) uniform sampler2D maximumMap;  // its level i is the pyramid's level i + 1
uniform int levels, refinements, budgetPerAxis;
// Iterations that the driver's compiler allows a shader: llvmpipe leaves all loops silently after 65,535.
uniform int maxIterations;

void clearGathered();
bool isSaturated();
float gatheredVisibility();

// Texels [low, high) of level 0.
struct Area {
  ivec2 low, high;
};

// Texels by which occluders whose corners are texel centres reach beyond the texels that they cover.
#if OCCLUDERS == 0
const float kAreaBorder = 0.0;
#else
const float kAreaBorder = 0.5;
#endif

// Cut of the pyramid from the receiver to the light with the plane z, as texels; clipped to the map.
Area searchArea(vec4 p, float z, out bool reachesOutside) {
  const vec2 centre = p.xy / p.z;
  const vec2 halfSize = 0.5 * lightSize * max(1.0 / z - 1.0 / p.z, 0.0);
  const vec2 low = floor(mapTexel(centre - halfSize) - kAreaBorder);
  const vec2 high = ceil(mapTexel(centre + halfSize) + kAreaBorder);
  reachesOutside = any(lessThan(low, vec2(0.0))) || any(greaterThan(high, vec2(float(resolution))));
  const vec2 limit = vec2(float(resolution));
  return Area(ivec2(clamp(low, vec2(0.0), limit)), ivec2(clamp(high, vec2(0.0), limit)));
}

#include "renderer/techniques/soft_shadows/depth_bounds_hsm.glsl"

// Narrows the search area of a receiver, or finds that it needs none: false, with the visibility that is known then.
bool findArea(vec4 p, out Area area, out float visibility) {
  visibility = 1.0;
  bool reachesOutside;
  // The first area is cut by the nearest surface of the whole map: conservative, and far smaller than by the near plane.
  float nearest = max(near, texelFetch(minimumMap, ivec2(0), levels - 1).x);
  fetchCount = 1u;
  pixelClass = kLit;
  if (nearest >= biasedDepth(p, 0)) return false;
  for (int i = 0;; ++i) {
    area = searchArea(p, nearest, reachesOutside);
    if (any(greaterThanEqual(area.low, area.high))) {
      if (reachesOutside) pixelClass = kOutside;
      return false;
    }
    const vec2 range = depthRange(area);
    fetchCount += 8u;
    if (range.x >= biasedDepth(p, 0)) return false;
    // All texels block: neighbouring texels are taken as one surface.
    if (range.y < biasedDepth(p, 0) && !reachesOutside) {
      pixelClass = kUmbra;
      visibility = 0.0;
      return false;
    }
    if (i >= refinements || range.x <= nearest) break;
    nearest = range.x;
  }
  return true;
}

// Micro-occluders of a level, from `low` to `high`; none if `high` is below `low`.
struct Range {
  ivec2 low, high;
};

// Those that may matter for an area, rounded outward to the level's grid.
Range occluderRange(Area area, int level);

// Finest level at which the area's micro-occluders keep within the budget on both axes.
int microOccluderLevel(Area area) {
  int level = 0;
  while (level < levels - 1) {
    const Range range = occluderRange(area, level);
    const ivec2 count = range.high - range.low + 1;
    if (max(count.x, count.y) <= budgetPerAxis) break;
    ++level;
  }
  return level;
}

// z / (p_z - z): how far depth z throws from the receiver onto the light. `depth` < p_z is what z has undercut.
float throwOf(float z, float pz) { return z / (pz - z); }

#if OCCLUDERS == 0
#include "renderer/techniques/soft_shadows/micropatches.glsl"
#elif OCCLUDERS == 3
#include "renderer/techniques/soft_shadows/contours.glsl"
#else
#include "renderer/techniques/soft_shadows/microquads.glsl"
#endif

float visibilityOf(vec4 p, ivec2 pixel) {
  Area area;
  float visibility;
  if (!findArea(p, area, visibility)) return visibility;
  pixelClass = kProcessed;
  clearGathered();
  const int level = microOccluderLevel(area);
  levelUsed = uint(level);
  return gatherOccluders(p, area, level);
}
