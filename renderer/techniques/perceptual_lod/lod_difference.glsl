// SPDX-License-Identifier: BSD-3-Clause
// Where an object is seen, and where its current level differs visibly from the finest.
#include "renderer/techniques/perceptual_lod/gathered.glsl"

layout(binding = kLevelTestPictureUnit) uniform sampler2D picture;
layout(binding = kLevelTestBehindUnit) uniform sampler2D behind;
layout(binding = kLevelTestThresholdUnit) uniform sampler2D threshold;

uniform int test;

struct Seen {
  bool covered, visible, nextVisible;
};

// Luminance of the pixel with a version of the object. `others` is the nearest surface without the object and `without`
// the luminance then seen.
float luminanceWith(int region, int lightRegion, ivec2 pixel, Key others, float without, out bool covered) {
  const Key key = keyIn(region, pixel);
  covered = key.depth > 0.0 && isNearer(key, others);
  return covered ? luminanceCdM2(colourOf(key, pixel, test, lightRegion)) : without;
}

Seen look(ivec2 pixel) {
  const PlannedTest plan = tests[test];
  Key front, second;
  int layer;
  surfacesAt(pixel, front, layer, second);
  const float shown = luminanceCdM2(texelFetch(picture, pixel, 0).rgb);
  const bool covered = front.depth > 0.0 && front.triangle - plan.firstTriangle < plan.triangleCount;
  Key others = front;
  float without = shown;
  if (covered) {
    others = second;
    without = texelFetch(behind, pixel, 0).x;
  }
  const float limit = texelFetch(threshold, pixel, 0).x;
  bool finestCovered = covered;
  float wanted = shown;
  if (plan.cameraFinest >= 0)
    wanted = luminanceWith(plan.cameraFinest, plan.lightFinest, pixel, others, without, finestCovered);
  Seen seen;
  seen.covered = covered || finestCovered;
  seen.visible = seen.covered && abs(wanted - shown) > limit;
  seen.nextVisible = false;
  if (plan.cameraNext >= 0) {
    bool nextCovered;
    const float offered = luminanceWith(plan.cameraNext, plan.lightNext, pixel, others, without, nextCovered);
    seen.nextVisible = (finestCovered || nextCovered) && abs(wanted - offered) > limit;
  }
  return seen;
}
