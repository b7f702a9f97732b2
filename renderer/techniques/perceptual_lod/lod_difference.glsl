// SPDX-License-Identifier: BSD-3-Clause
// Where an object is seen, and where its current level differs visibly from the finest.
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"
#include "renderer/techniques/perceptual_lod/surface_key.glsl"

layout(binding = kLevelTestFrontColourUnit) uniform sampler2D frontColour;
layout(binding = kLevelTestFrontKeyUnit) uniform usampler2D frontKey;
layout(binding = kLevelTestSecondColourUnit) uniform sampler2D secondColour;
layout(binding = kLevelTestSecondKeyUnit) uniform usampler2D secondKey;
layout(binding = kLevelTestThresholdUnit) uniform sampler2D threshold;
layout(binding = kLevelTestFinestColourUnit) uniform sampler2D finestColour;
layout(binding = kLevelTestFinestDepthUnit) uniform sampler2D finestDepth;
layout(binding = kLevelTestFinestIdsUnit) uniform usampler2D finestIds;
#ifdef NEXT
layout(binding = kLevelTestNextColourUnit) uniform sampler2D nextColour;
layout(binding = kLevelTestNextDepthUnit) uniform sampler2D nextDepth;
layout(binding = kLevelTestNextIdsUnit) uniform usampler2D nextIds;
#endif

uniform uint firstTriangle, triangleCount;  // of the object's current level
uniform float blackCdM2, rangeCdM2;         // of the display

struct Seen {
  bool covered, visible, nextVisible;
};

// As perception::DisplayProfile::luminanceCdM2.
float luminanceCdM2(vec3 linearRgb) {
  const vec3 weights = vec3(0.2126729, 0.7151522, 0.0721750) / 1.0000001;
  // Written so that a NaN becomes 0.
  const vec3 light = mix(vec3(0.0), min(linearRgb, vec3(1e6)), greaterThan(linearRgb, vec3(0.0)));
  return blackCdM2 + rangeCdM2 * dot(weights, light);
}

// Luminance of the pixel with a version of the object that has surface `key` there. `others` is the nearest
// surface without the object and `without` the colour then seen.
float luminanceWith(Key key, vec3 colour, Key others, vec3 without, out bool covered) {
  covered = key.depth > 0.0 && isNearer(key, others);
  return luminanceCdM2(covered ? colour : without);
}

Seen look(ivec2 pixel) {
  const Key front = unpackKey(texelFetch(frontKey, pixel, 0));
  const vec3 shown = texelFetch(frontColour, pixel, 0).rgb;
  const bool covered = front.depth > 0.0 && front.triangle - firstTriangle < triangleCount;
  Key others = front;
  vec3 without = shown;
  if (covered) {
    others = unpackKey(texelFetch(secondKey, pixel, 0));
    without = texelFetch(secondColour, pixel, 0).rgb;
  }
  const float limit = texelFetch(threshold, pixel, 0).x;
  bool finestCovered;
  const Key finest = Key(texelFetch(finestDepth, pixel, 0).x, texelFetch(finestIds, pixel, 0).x, 0u);
  const float wanted =
      luminanceWith(finest, texelFetch(finestColour, pixel, 0).rgb, others, without, finestCovered);
  Seen seen;
  seen.covered = covered || finestCovered;
  seen.visible = seen.covered && abs(wanted - luminanceCdM2(shown)) > limit;
  seen.nextVisible = false;
#ifdef NEXT
  bool nextCovered;
  const Key next = Key(texelFetch(nextDepth, pixel, 0).x, texelFetch(nextIds, pixel, 0).x, 0u);
  const float offered = luminanceWith(next, texelFetch(nextColour, pixel, 0).rgb, others, without, nextCovered);
  seen.nextVisible = (finestCovered || nextCovered) && abs(wanted - offered) > limit;
#endif
  return seen;
}
