// SPDX-License-Identifier: BSD-3-Clause
// Colour of one sample of a window of WINDOW x WINDOW samples a pixel. See sample_view.h.
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

uniform ivec2 sizePx;  // of the samples' image
#if GRADIENTS != GRADIENTS_NONE
#define FILTERED_PATTERN
#endif
#include "renderer/techniques/antialiasing/surface_colour.glsl"

layout(binding = kSampleIdsUnit) uniform usampler2D sampleIds;

const int kSamples = WINDOW * WINDOW;
// Place in its window, column and row, of the sample that is shaded n-th.
const ivec2 kOrder[kSamples] = ivec2[](ORDER);

#if GRADIENTS != GRADIENTS_NONE
#include "renderer/techniques/antialiasing/sample_footprint.glsl"
#endif

// `shaded`: how many samples of its pixel are.
vec3 sampleColour(ivec2 place, int shaded) {
  const uint id = texelFetch(sampleIds, place, 0).x;
  if (id == 0xffffffffu) return background;
  SeenPoint seen;
  const SurfacePoint point = surfaceSeen(place, id, seen);
#if GRADIENTS != GRADIENTS_NONE
  setFootprint(place, id, seen, sqrt(float(kSamples) / float(shaded)));
#endif
  return surfaceColour(point, seen);
}
