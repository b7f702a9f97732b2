// SPDX-License-Identifier: BSD-3-Clause
// KEEP_MASKS: masks of all pixels stay in an image, so that further maps add to them and other passes read them. Not where
// LEVEL_STEPS tries levels that no pixel has chosen.

#ifdef LEVEL_STEPS
#undef KEEP_MASKS
#endif
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#ifdef KEEP_MASKS
// What the search finds is not yet the pixel's visibility.
#define visibilityOf visibilityInMap
#endif
#include "renderer/techniques/soft_shadows/occluder_search.glsl"
#undef visibilityOf
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"
#if OCCLUDERS == OCCLUDERS_MICROQUADS || OCCLUDERS == OCCLUDERS_MICROQUADS_MICROTRIS
#include "renderer/techniques/soft_shadows/bitmask/quad_mask.glsl"
void accumulateQuad(vec2 a, vec2 b, vec2 c, vec2 d) { addQuadToMask(a, b, c, d); }
#endif

void accumulate(vec2 low, vec2 high) { addToMask(low, high); }
bool isSaturated() { return allCovered(); }
float gatheredVisibility() { return visibleShare(); }

#ifndef KEEP_MASKS
void clearGathered() { clearMask(); }
#else
layout(binding = kKeptMasksImage, rgba32ui) uniform uimage2DArray keptMasks;
#include "renderer/techniques/soft_shadows/bitmask/kept_masks.glsl"
uniform int keptSet;  // of the masks in the image
uniform int joins;    // 0: the set's first map

// The mask holds what earlier maps found.
void clearGathered() {}

float visibilityOf(vec4 p, ivec2 pixel) {
  clearMask();
  if (joins != 0) addKeptMask(pixel, keptSet);
  if (allCovered()) {
    pixelClass = kLit;  // nothing to do
    return 0.0;
  }
  const float visibility = visibilityInMap(p, pixel);
  if (pixelClass == kCutShort) return visibility;
  if (pixelClass == kUmbra) coverAll();
  for (int layer = 0; layer < KEPT_LAYERS; ++layer)
    imageStore(keptMasks, ivec3(pixel, keptSet * KEPT_LAYERS + layer), wordsOf(layer));
  return gatheredVisibility();
}
#endif
