// SPDX-License-Identifier: BSD-3-Clause
// What a change of level from a pixel to its neighbour does by itself: visibility of this pixel's own receiver and search
// area at the level that the pixel at `offset` has chosen. Run once with the offset 0, then for the neighbours, each in a
// dispatch of its own, so that none has more loop iterations than the technique itself. See level_steps.h.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

layout(binding = kStepsCountedWorkImage, rgba32ui) uniform readonly uimage2D countedWork;
layout(binding = kStepsCountedSearchImage, rgba32ui) uniform readonly uimage2D countedSearch;
layout(binding = kStepsImage, rg32f) uniform writeonly image2D outSteps;  // visibility, choice; -1: none, or no pair
layout(binding = kStepsPositionsUnit) uniform sampler2D positions;
layout(binding = kStepsNormalsUnit) uniform sampler2D normals;

uniform ivec2 offset;
uniform float surfaceSlope;

bool isProcessed(ivec2 pixel) {
  return all(lessThan(pixel, sizePx)) && imageLoad(countedWork, pixel).x == kProcessed;
}

float levelChosen(ivec2 pixel) { return uintBitsToFloat(imageLoad(countedSearch, pixel).w); }

// The level between two whole ones that a choice amounts to: equal where the same levels count with the same weights.
float choiceAt(ivec2 pixel) {
  const float level = levelChosen(pixel);
#ifdef ONE_LEVEL
  return level;
#else
  return floor(level) + coarserWeight(level - floor(level), pixel);
#endif
}

// The line between the points keeps near to both tangent planes; a step from one surface to another leaves at least one.
bool onOneSurface(ivec2 a, ivec2 b) {
  const vec3 between = texelFetch(positions, b, 0).xyz - texelFetch(positions, a, 0).xyz;
  const float away = max(abs(dot(texelFetch(normals, a, 0).xyz, between)), abs(dot(texelFetch(normals, b, 0).xyz, between)));
  return away <= surfaceSlope * length(between);
}

bool isPair(ivec2 pixel, ivec2 neighbour) { return isProcessed(neighbour) && onOneSurface(pixel, neighbour); }

bool differs(ivec2 pixel, ivec2 neighbour) {
  return isPair(pixel, neighbour) && choiceAt(pixel) != choiceAt(neighbour);
}

// Visibility of `pixel` at the level that `chooser` has chosen; below 0: this program, compiled apart from the one that
// counted, finds a pixel at the brink of it in no need of processing.
float visibilityAsChosen(ivec2 pixel, ivec2 chooser) {
  const vec4 receiver = texelFetch(receivers, pixel, 0);
  Area area;
  float visibility;
  readBudget(pixel);
  if (!findArea(receiver, area, visibility)) return -1.0;
  return visibilityAt(receiver, area, levelChosen(chooser), chooser);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const ivec2 chooser = pixel + offset;
  const bool own = offset == ivec2(0);
  vec2 result = vec2(0.0, -1.0);
  if (isProcessed(pixel) && (own || isPair(pixel, chooser))) {
    result.y = choiceAt(chooser);
    const bool counts = own ? differs(pixel, pixel + ivec2(1, 0)) || differs(pixel, pixel + ivec2(0, 1))
                            : choiceAt(pixel) != result.y;
    if (counts) result.x = visibilityAsChosen(pixel, chooser);
    if (result.x < 0.0) result = vec2(0.0, -1.0);
  }
  imageStore(outSteps, pixel, vec4(result, 0.0, 0.0));
}
