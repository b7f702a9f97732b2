// SPDX-License-Identifier: BSD-3-Clause
// Finds the texels of the shadow map that can matter for a receiver, and has them gathered. Schwarz 2009, sections 4.1 and
// 4.2. The including shader defines what is gathered: clearGathered(), isSaturated(), gatheredVisibility(), and what the
// file of occluders asks for.
// OCCLUDERS: see occluder_kinds.h.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/depth_bounds.glsl"
uniform int levels, refinements;
uniform int fixedLevel;  // of all micro-occluders; below 0: by the budget
uniform int roughQueries;  // as many depth ranges of a pixel, the first ones, may be rough
#ifdef SEARCH_CELLS
uniform float leastWidth;  // of the light as projected onto the map, in texels
#endif
// Iterations that the driver's compiler allows a shader: llvmpipe leaves all loops silently after 65,535.
uniform int maxIterations;

void clearGathered();
// Enters what of the light is behind the receiver's plane; after clearGathered().
void hideBehindPlane(vec4 p);
bool isSaturated();
float gatheredVisibility();
#if LANES > 1
const uint kGroupPixels = kWorkListGroup / LANES;  // see listedPixel()
// Joins what the LANES invocations of each pixel have gathered, in all of them; called by all of the group.
void joinLanes();
#endif
#if defined(KEEP_MASKS) && MAP_LAYERS > 1
void keepGathered(ivec2 pixel);
#elif defined(KEEP_MASKS)
void resumeGathered(ivec2 pixel);
void keepGathered(ivec2 pixel);
bool coveredBefore(vec4 p, ivec2 pixel);
float visibilityKept(ivec2 pixel, float visibility);
#endif

// Texels by which occluders whose corners are texel centres reach beyond the texels that they cover.
#if OCCLUDERS == OCCLUDERS_MICROPATCHES || OCCLUDERS == OCCLUDERS_MICRORECTS
const float kAreaBorder = 0.0;
#else
const float kAreaBorder = 0.5;
#endif

// Cut of the pyramid from the receiver to the light with the plane z, as texels; clipped to the map.
Area searchArea(vec4 p, float z, out bool reachesOutside) {
#ifdef SEARCH_CELLS
  const vec2 perLength = max(vec2(1.0 / z - 1.0 / p.z), leastWidth * tangentSize / (float(resolution) * lightSize));
#else
  const float perLength = max(1.0 / z - 1.0 / p.z, 0.0);
#endif
  const vec2 centre = p.xy / p.z + (0.5 - eyeOnLight) * lightSize * perLength;
  const vec2 halfSize = 0.5 * lightSize * perLength;
  const vec2 low = floor(mapTexel(centre - halfSize) - kAreaBorder);
  const vec2 high = ceil(mapTexel(centre + halfSize) + kAreaBorder);
  reachesOutside = any(lessThan(low, vec2(0.0))) || any(greaterThan(high, vec2(float(resolution))));
  const vec2 limit = vec2(float(resolution));
  return Area(ivec2(clamp(low, vec2(0.0), limit)), ivec2(clamp(high, vec2(0.0), limit)));
}

// Micro-occluders of a level, from `low` to `high`; none if `high` is below `low`.
struct Range {
  ivec2 low, high;
};

// Rows of micro-occluders that this invocation gathers: all, unless several share a pixel.
int firstRow = 0, rowStep = 1;
int rowsToGather(int rows) { return max(rows - firstRow + rowStep - 1, 0) / rowStep; }

// Those that may matter for an area, rounded outward to the level's grid.
Range occluderRange(Area area, int level);

// Visibility by the micro-occluders of a level that lie in the area.
float gatherOccluders(vec4 p, Area area, int level);

#include "renderer/techniques/soft_shadows/quality/level_of_quality.glsl"

#if OCCLUDERS == OCCLUDERS_MICRORECTS || OCCLUDERS == OCCLUDERS_MORPHING_MICROQUADS
// Texels that micro-occluders in range may be made of; these may lie anywhere about their own one.
Area areaOfRange(Range range, int level);
#endif

// Area of which the depth range decides. A coarse micro-occluder that the search area cuts stands for texels outside of it
// too: left out, they would make points fully lit that neighbours, with one texel of the occluder in their area, find
// shadowed by all of it. Schwarz 2009, section 4.3.1 ("over-precision"). Tiles of the HSM are whole ones at any level that a
// budget of 4 or more leads to. Cells end where the area does.
Area queriedArea(Area area) {
#if OCCLUDERS == OCCLUDERS_MICRORECTS || OCCLUDERS == OCCLUDERS_MORPHING_MICROQUADS
  const int level = int(ceil(levelOfArea(area)));
  return areaOfRange(occluderRange(area, level), level);
#elif defined(GROW) && !defined(SEARCH_CELLS)
  const int level = int(ceil(levelOfArea(area)));
  return Area((area.low >> level) << level, (((area.high - 1) >> level) + 1) << level);
#else
  return area;
#endif
}

// Depth below which all texels of an area are taken to block. The receiver's plane may come nearer to the light within the area;
// its own texels would then count too, but only where all others hide the light as well.
float leastDepthOf(vec4 p) {
#ifdef BIAS_PLANE
  if (eyeIsBehind) return 0.0;  // what blocks is beyond the plane
  return p.z * (1.0 - planeMargin(slopeBias + 2.0));
#else
  return biasedDepth(p, 0);
#endif
}

// Narrows the search area of a receiver, or finds that it needs none: false, with the visibility that is known then.
bool findArea(vec4 p, out Area area, out float visibility) {
  visibility = 1.0;
  bool reachesOutside;
  // The first area is cut by the nearest surface of the whole map: conservative, and far smaller than by the near plane.
  float nearest = max(near, minimumDepth(ivec2(0), levels - 1));
  fetchCount = 1u;
  pixelClass = kLit;
  if (nearest >= biasedDepth(p, 0)) return false;
  for (int i = 0;; ++i) {
    area = searchArea(p, nearest, reachesOutside);
    if (any(greaterThanEqual(area.low, area.high))) {
      if (reachesOutside) pixelClass = kOutside;
      return false;
    }
    const bool rough = i < roughQueries;
    const vec2 range = depthRange(queriedArea(area), rough);
    fetchCount = 1u + boundFetches;
    if (range.x >= biasedDepth(p, 0)) return false;
    // All texels block: neighbouring texels are taken as one surface, unless other maps see between them (GAPS_OPEN). Biases of
    // their own may lie below any such range.
#if !defined(BIAS_STORED) && !defined(GAPS_OPEN)
    if (range.y < leastDepthOf(p) && !reachesOutside) {
      pixelClass = kUmbra;
      visibility = 0.0;
      return false;
    }
#endif
    // Unless the next query is a better one, it would get the same answer.
    if (i >= refinements || (range.x <= nearest && rough == (i + 1 < roughQueries))) break;
    nearest = max(nearest, range.x);
  }
  return true;
}

// z / (p_z - z): how far depth z throws from the receiver onto the light. `depth` < p_z is what z has undercut.
float projectionScale(float z, float pz) { return z / (pz - z); }

#ifdef BIAS_STORED
layout(binding = kTexelBiasesUnit) uniform sampler2D texelBiases;
uniform float storedScale;
#endif

#include "renderer/techniques/soft_shadows/level_depths.glsl"

// Whether depth z of a texel of a level blocks a receiver of biased depth `depth`.
bool blocks(float z, ivec2 texel, int level, vec4 p, float depth) {
#ifdef BIAS_PLANE
  if (!(z < depth)) return false;
  return beforePlane(z, depthPlace(texel, level), p, p.z * (1.0 - planeMargin(slopeBias + depthSpread(level))));
#elif defined(BIAS_STORED)
  if (!(z < depth)) return false;
  ++fetchCount;
  return z + storedScale * texelFetch(texelBiases, texel, level).x < depth;
#else
  return z < depth;
#endif
}

// Here and not in both: a file is taken in once, also where what asks for it first is left out.
#if OCCLUDERS == OCCLUDERS_MICROPATCHES || OCCLUDERS == OCCLUDERS_MICRORECTS
#include "renderer/techniques/soft_shadows/light_rectangle.glsl"
#endif
#if OCCLUDERS == OCCLUDERS_MICROPATCHES
#include "renderer/techniques/soft_shadows/micropatches.glsl"
#elif OCCLUDERS == OCCLUDERS_CONTOURS
#include "renderer/techniques/soft_shadows/contours.glsl"
#elif OCCLUDERS == OCCLUDERS_MICRORECTS
#include "renderer/techniques/soft_shadows/microrects.glsl"
#elif OCCLUDERS == OCCLUDERS_MORPHING_MICROQUADS
#include "renderer/techniques/soft_shadows/morphing_quads.glsl"
#else
#include "renderer/techniques/soft_shadows/microquads.glsl"
#endif

// Visibility of a receiver that nothing shadows (`visibility` 1) or everything does.
float visibilityUnprocessed(vec4 p, float visibility) {
#ifdef BIAS_PLANE
  if (visibility > 0.0 && planeCutsLight(p)) {
    clearGathered();
    hideBehindPlane(p);
    return gatheredVisibility();
  }
#endif
  return visibility;
}

#if MAP_LAYERS > 1
#include "renderer/techniques/soft_shadows/layer_search.glsl"
#endif
#if defined(SPLIT_CLASSIFY) || defined(SPLIT_GATHER)
#include "renderer/techniques/soft_shadows/quality/split_search.glsl"
#elif defined(LEVEL_STEPS)
#include "renderer/techniques/soft_shadows/quality/level_steps.glsl"
#elif MAP_LAYERS > 1
Area areas[MAP_LAYERS];
float areaLevels[MAP_LAYERS];
void noteArea(ivec2 pixel, Area area, float level) {
  areas[mapLayer] = area;
  areaLevels[mapLayer] = level;
}
float notedArea(ivec2 pixel, int layer, out Area area) {
  area = areas[layer];
  return areaLevels[layer];
}
float visibilityOf(vec4 p, ivec2 pixel) {
  float visibility;
  readBudget(pixel);
  if (!findAreas(pixel, visibility)) return visibilityOfNone(p, pixel, visibility);
  clearGathered();
  hideBehindPlane(p);
  if (!gatherLayers(pixel, true)) return uintBitsToFloat(0x7fc00000u);
#ifdef KEEP_MASKS
  keepGathered(pixel);
#endif
  return gatheredVisibility();
}
#else
float visibilityOf(vec4 p, ivec2 pixel) {
  Area area;
  float visibility;
  readBudget(pixel);
  if (!findArea(p, area, visibility)) return visibilityUnprocessed(p, visibility);
  return visibilityAt(p, area, qualityLevel(p, area), pixel);
}
#endif
