// SPDX-License-Identifier: BSD-3-Clause
// The search in passes of its own. SPLIT_CLASSIFY: visibility of pixels that need no processing, and for the others search
// area, level and a place in the list. SPLIT_GATHER: the loop over micro-occluders for each listed pixel, with no others
// between them. Schwarz 2009, sections 4.1 and 5.2.1.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/quality/work_list.glsl"

#ifdef SPLIT_CLASSIFY
// Areas: low, high. Levels: -1 where a layer has nothing to gather or levels are smoothed and the pixel is not processed.
#if MAP_LAYERS > 1
layout(binding = kSplitAreasImage, rgba16ui) uniform writeonly uimage2DArray outAreas;
layout(binding = kSplitLevelsImage, r32f) uniform writeonly image2DArray outLevels;
#else
layout(binding = kSplitAreasImage, rgba16ui) uniform writeonly uimage2D outAreas;
#ifdef SMOOTH
layout(binding = kSplitCameraDepthUnit) uniform sampler2D cameraDepth;
layout(binding = kSplitLevelsImage, rg32f) uniform writeonly image2D outLevels;    // level, camera depth
layout(binding = kSplitHalfSmoothedImage, rg32f) uniform writeonly image2D outHalfSmoothed;
#else
layout(binding = kSplitLevelsImage, r32f) uniform writeonly image2D outLevels;
#endif
#endif

// Of the next list, made empty here so that no copy has to be waited for.
layout(std430, binding = kNextWorkHeaderBuffer) restrict writeonly buffer NextWorkHeader { WorkListHeader nextWork; };

shared uint processedLanes[2];
shared uint firstSlot;

#if MAP_LAYERS > 1
void noteArea(ivec2 pixel, Area area, float level) {
  imageStore(outLevels, ivec3(pixel, mapLayer), vec4(level));
  if (level >= 0.0) imageStore(outAreas, ivec3(pixel, mapLayer), uvec4(area.low, area.high));
}

bool classify(ivec2 pixel) {
  const vec4 receiver = loadReceiver(pixel);
  float visibility = 1.0;
  bool processed = false;
  readBudget(pixel);
  if (receiver.w >= 0.0) {
    processed = findAreas(pixel, visibility);
    if (!processed) visibility = visibilityOfNone(receiver, pixel, visibility);
  }
  if (!processed) store(pixel, visibility);
#ifdef COUNT
  if (processed) imageStore(outCounts, pixel, uvec4(0u, 0u, fetchCount, 0u));
#endif
  return processed;
}
#else
bool classify(ivec2 pixel) {
  const vec4 receiver = loadReceiver(pixel);
  Area area;
  float visibility = 1.0;
  bool processed = false;
  readBudget(pixel);
  if (receiver.w >= 0.0) {
#ifdef KEEP_MASKS
    if (coveredBefore(receiver, pixel)) {
      visibility = 0.0;
    } else {
      processed = findArea(receiver, area, visibility);
      if (!processed) visibility = visibilityKept(pixel, visibilityUnprocessed(receiver, visibility));
    }
#else
    processed = findArea(receiver, area, visibility);
    if (!processed) visibility = visibilityUnprocessed(receiver, visibility);
#endif
  }
  if (!processed) {
    store(pixel, visibility);
#ifdef SMOOTH
    // What the walk along either axis stops at.
    imageStore(outLevels, pixel, vec4(-1.0, 0.0, 0.0, 0.0));
    imageStore(outHalfSmoothed, pixel, vec4(-1.0, 0.0, 0.0, 0.0));
#endif
    return false;
  }
  const float level = qualityLevel(receiver, area);
  imageStore(outAreas, pixel, uvec4(area.low, area.high));
#ifdef SMOOTH
  imageStore(outLevels, pixel, vec4(level, texelFetch(cameraDepth, pixel, 0).x, 0.0, 0.0));
#else
  imageStore(outLevels, pixel, vec4(level));
#endif
#ifdef COUNT
  imageStore(outCounts, pixel, uvec4(0u, 0u, fetchCount, 0u));
#endif
  return true;
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const uint lane = gl_LocalInvocationIndex;
  if (pixel == ivec2(0)) nextWork = WorkListHeader(work.groupsPerRow, 0u, work.groupLayers, 0u);
  if (lane < 2u) processedLanes[lane] = 0u;
  memoryBarrierShared();
  barrier();
  bool processed = false;
  if (all(lessThan(pixel, sizePx))) processed = classify(pixel);
  if (processed) atomicOr(processedLanes[lane >> 5], 1u << (lane & 31u));
  memoryBarrierShared();
  barrier();
  const uint before = uint(bitCount(processedLanes[0])), total = before + uint(bitCount(processedLanes[1]));
  if (lane == 0u && total > 0u) {
    firstSlot = atomicAdd(work.pixelCount, total);
    const uint perRow = kWorkListGroup * work.groupsPerRow;
    // Whoever begins a row counts it.
    const uint rows = (firstSlot + total + perRow - 1u) / perRow;
    if (rows > (firstSlot + perRow - 1u) / perRow) atomicMax(work.groupRows, rows);
  }
  memoryBarrierShared();
  barrier();
  if (!processed) return;
  const uint lower = processedLanes[lane >> 5] & ((1u << (lane & 31u)) - 1u);
  const uint rank = uint(bitCount(lower)) + (lane < 32u ? 0u : before);
  listedPixels[firstSlot + rank] = uint(pixel.x) | (uint(pixel.y) << 16);
}
#else
#if MAP_LAYERS > 1
layout(binding = kSplitSearchAreasUnit) uniform usampler2DArray searchAreas;
layout(binding = kSplitLevelMapUnit) uniform sampler2DArray levelMap;

float notedArea(ivec2 pixel, int layer, out Area area) {
  const float level = texelFetch(levelMap, ivec3(pixel, layer), 0).x;
  if (level < 0.0) return level;
  const uvec4 bounds = texelFetch(searchAreas, ivec3(pixel, layer), 0);
  area = Area(ivec2(bounds.xy), ivec2(bounds.zw));
  return level;
}
#else
layout(binding = kSplitSearchAreasUnit) uniform usampler2D searchAreas;
layout(binding = kSplitLevelMapUnit) uniform sampler2D levelMap;

Area searchedArea(ivec2 pixel) {
  const uvec4 area = texelFetch(searchAreas, pixel, 0);
  return Area(ivec2(area.xy), ivec2(area.zw));
}
#endif

#if LANES > 1
// Of the pixels of a group.
shared uint sharedCutShort[kGroupPixels];
#ifdef COUNT
shared uint sharedCounts[kGroupPixels][4];  // what their invocations counted
#endif

void main() {
  const uint lane = gl_LocalInvocationIndex / kGroupPixels, slot = gl_LocalInvocationIndex % kGroupPixels;
  ivec2 pixel = ivec2(0);
  const bool listed = listedPixel(pixel);
  if (lane == 0u) {
    sharedCutShort[slot] = 0u;
#ifdef COUNT
    for (int i = 0; i < 4; ++i) sharedCounts[slot][i] = 0u;
#endif
  }
  memoryBarrierShared();
  barrier();
  float visibility = 0.0;
#if MAP_LAYERS > 1
  clearGathered();
  if (listed) {
    readBudget(pixel);
    firstRow = int(lane);
    rowStep = LANES;
    if (lane == 0u) hideBehindPlane(loadReceiver(pixel));
  }
  if (!gatherLayers(pixel, listed)) atomicOr(sharedCutShort[slot], 1u);
  joinLanes();
  if (listed) visibility = gatheredVisibility();
#else
  vec4 receiver = vec4(0.0);
  Area area = Area(ivec2(0), ivec2(0));
  int first = 0, last = -1;
  float weight = 0.0;
  bool within = true;
  if (listed) {
    receiver = loadReceiver(pixel);
    readBudget(pixel);
    area = searchedArea(pixel);
    within = beginLevels(area, texelFetch(levelMap, pixel, 0).x, pixel, first, last, weight);
    firstRow = int(lane);
    rowStep = LANES;
  }
  for (int i = 0; i < LEVELS_PER_PIXEL; ++i) {
    clearGathered();
    const bool has = within && first + i <= last;
    if (has) {
#ifdef KEEP_MASKS
      resumeGathered(pixel);
#endif
      if (lane == 0u) hideBehindPlane(receiver);
      gatherOccluders(receiver, area, first + i);
    }
    if (pixelClass == kCutShort) atomicOr(sharedCutShort[slot], 1u);
    joinLanes();
    if (has) {
      const float found = gatheredVisibility();
      visibility = i == 0 ? found : mix(visibility, found, weight);
    }
#if LEVELS_PER_PIXEL > 1
    barrier();  // before what is shared is written again
#endif
  }
#endif
#ifdef COUNT
  atomicAdd(sharedCounts[slot][0], occluderCount);
  atomicAdd(sharedCounts[slot][1], fetchCount);
  atomicAdd(sharedCounts[slot][2], examinedCount);
  atomicAdd(sharedCounts[slot][3], usedCount);
  memoryBarrierShared();
  barrier();
#endif
  if (!listed || lane != 0u) return;
  const bool cutShort = sharedCutShort[slot] != 0u;
#ifdef KEEP_MASKS
  if (!cutShort) keepGathered(pixel);
#endif
#ifdef COUNT
  occluderCount = sharedCounts[slot][0];
  fetchCount = imageLoad(outCounts, pixel).z + sharedCounts[slot][1];
  examinedCount = sharedCounts[slot][2];
  usedCount = sharedCounts[slot][3];
#endif
  if (cutShort) pixelClass = kCutShort;
  store(pixel, cutShort ? uintBitsToFloat(0x7fc00000u) : visibility);
}
#else
void main() {
  ivec2 pixel;
  if (!listedPixel(pixel)) return;
  const vec4 receiver = loadReceiver(pixel);
  readBudget(pixel);
#ifdef COUNT
  fetchCount = imageLoad(outCounts, pixel).z;
#endif
#if MAP_LAYERS > 1
  clearGathered();
  hideBehindPlane(receiver);
  const bool whole = gatherLayers(pixel, true);
#ifdef KEEP_MASKS
  if (whole) keepGathered(pixel);
#endif
  store(pixel, whole ? gatheredVisibility() : uintBitsToFloat(0x7fc00000u));
#else
#ifdef KEEP_MASKS
  coveredBefore(receiver, pixel);
#endif
  float visibility = visibilityAt(receiver, searchedArea(pixel), texelFetch(levelMap, pixel, 0).x, pixel);
#ifdef KEEP_MASKS
  visibility = visibilityKept(pixel, visibility);
#endif
  store(pixel, visibility);
#endif
}
#endif
#endif
