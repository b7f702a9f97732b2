// SPDX-License-Identifier: BSD-3-Clause
// KEEP_MASKS: masks of all pixels stay in an image, so that further maps add to them and other passes read them. Not where
// LEVEL_STEPS tries levels that no pixel has chosen. MAP_LAYERS: all maps add to the masks in one pass.

#ifdef LEVEL_STEPS
#undef KEEP_MASKS
#endif
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#if defined(KEEP_MASKS) && !(MAP_LAYERS > 1)
// What the search finds is not yet the pixel's visibility.
#define visibilityOf visibilityInMap
#endif
#include "renderer/techniques/soft_shadows/occluder_search.glsl"
#undef visibilityOf
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"
#include "renderer/techniques/soft_shadows/bitmask/mask_rows.glsl"
#if OCCLUDERS == OCCLUDERS_MICROQUADS || OCCLUDERS == OCCLUDERS_MICROQUADS_MICROTRIS
#include "renderer/techniques/soft_shadows/bitmask/quad_mask.glsl"
void accumulateQuad(vec2 a, vec2 b, vec2 c, vec2 d) { addQuadToMask(a, b, c, d); }
#endif

void accumulate(vec2 low, vec2 high) { addToMask(low, high); }
#if LANES > 1
shared uint laneMasks[MASK_WORDS][kWorkListGroup];
void joinLanes() {
  const uint own = gl_LocalInvocationIndex, lane = own / kGroupPixels, first = own % kGroupPixels;
  for (int i = 0; i < MASK_WORDS; ++i) laneMasks[i][own] = mask[i];
  memoryBarrierShared();
  barrier();
  for (uint i = lane; i < MASK_WORDS; i += LANES) {
    uint joined = 0u;
    for (uint other = 0u; other < LANES; ++other) joined |= laneMasks[i][first + other * kGroupPixels];
    laneMasks[i][first] = joined;
  }
  memoryBarrierShared();
  barrier();
  for (int i = 0; i < MASK_WORDS; ++i) mask[i] = laneMasks[i][first];
}
#endif
bool isSaturated() { return allCovered(); }
float gatheredVisibility() { return visibleShare(); }

#include "renderer/techniques/soft_shadows/bitmask/hidden_samples.glsl"
#ifndef KEEP_MASKS
void clearGathered() { clearMask(); }
#else
layout(binding = kKeptMasksImage, rgba32ui) uniform uimage2DArray keptMasks;
#include "renderer/techniques/soft_shadows/bitmask/kept_masks.glsl"
uniform int keptSet;  // of the masks in the image
uniform int joins;    // 0: the set's first map

// What earlier maps have covered.
void resumeGathered(ivec2 pixel) {
  if (joins != 0) addKeptMask(pixel, keptSet);
}
void keepGathered(ivec2 pixel) {
  for (int layer = 0; layer < KEPT_LAYERS; ++layer)
    imageStore(keptMasks, ivec3(pixel, keptSet * KEPT_LAYERS + layer), wordsOf(layer));
}

#if LANES > 1 || MAP_LAYERS > 1
void clearGathered() { clearMask(); }
#else
// The mask holds what earlier maps found.
void clearGathered() {}

// Whether nothing of the light is left for this map; the pixel is done then.
bool coveredBefore(vec4 p, ivec2 pixel) {
  clearMask();
  resumeGathered(pixel);
  if (joins == 0) hideBehindPlane(p);
  if (!allCovered()) return false;
  if (joins == 0) keepGathered(pixel);
  pixelClass = kLit;
  return true;
}

// After a pixel's search in this map.
float visibilityKept(ivec2 pixel, float visibility) {
  if (pixelClass == kCutShort) return visibility;
  if (pixelClass == kUmbra) coverAll();
  keepGathered(pixel);
  return gatheredVisibility();
}

#if !defined(SPLIT_CLASSIFY) && !defined(SPLIT_GATHER)
float visibilityOf(vec4 p, ivec2 pixel) {
  return coveredBefore(p, pixel) ? 0.0 : visibilityKept(pixel, visibilityInMap(p, pixel));
}
#endif
#endif
#endif
