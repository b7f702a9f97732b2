// SPDX-License-Identifier: BSD-3-Clause
// The surfaces of a frame's regions, and the light on them: layers, and the versions of the objects under test.
uniform ivec2 sizePx;
#include "renderer/frame/shading.glsl"
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"
#include "renderer/techniques/perceptual_lod/surface_key.glsl"
#ifdef SHADOW
#include "renderer/frame/receiver.glsl"
#include "renderer/frame/shadow_depth.glsl"
uniform vec2 tangentLow, tangentSize;
uniform int resolution;
uniform float bias, slopeBias, maxSlope;
uniform float lightNear;
#endif

layout(std140, binding = kRasterRegionsBlock) uniform Regions { RasterRegion regions[kMostRasterRegions]; };
layout(std140, binding = kPlannedTestsBlock) uniform PlannedTests { PlannedTest tests[kMostTests]; };
layout(std430, binding = kGatheredBuffer) readonly buffer Gathered { uint gathered[]; };

uniform int layerCount, testCount;
uniform float blackCdM2, rangeCdM2;  // of the display

const int kNoTest = -1, kNoLayer = -1;

// Where a pixel's result is in a region, in pixels; negative outside.
int placeIn(RasterRegion region, ivec2 pixel) {
  if (any(lessThan(pixel, region.low)) || any(greaterThanEqual(pixel, region.high))) return -1;
  const ivec2 at = pixel - region.low;
  return at.y * (region.high.x - region.low.x) + at.x;
}

Key keyIn(int index, ivec2 pixel) {
  const int place = placeIn(regions[index], pixel);
  if (place < 0) return Key(0.0, 0xffffffffu);
  const int word = regions[index].at + 2 * place;
  return Key(uintBitsToFloat(gathered[word]), ~gathered[word + 1]);
}

// The nearest surface of all layers, its layer, and the nearest surface of another layer: together they give the picture
// and, for each layer, the picture of all others.
void surfacesAt(ivec2 pixel, out Key front, out int frontLayer, out Key second) {
  front = second = Key(0.0, 0xffffffffu);
  frontLayer = 0;
  for (int layer = 0; layer < layerCount; ++layer) {
    const Key key = keyIn(kFirstCameraRegion + layer, pixel);
    if (key.depth == 0.0) continue;
    if (isNearer(key, front)) {
      second = front;
      front = key;
      frontLayer = layer;
    } else if (isNearer(key, second)) {
      second = key;
    }
  }
}

#ifdef SHADOW
float nearestIn(int index, ivec2 texel) {
  const int place = placeIn(regions[index], texel);
  return place < 0 ? 0.0 : uintBitsToFloat(gathered[regions[index].at + place]);
}

// Whether a receiver is shadowed by what casts shadows outside the layer `leftOut`, one object under test being cast with
// region `version` in place of its current level. The comparison is that of renderer/frame/shaded.comp.glsl.
bool isShadowed(vec4 receiver, int leftOut, int castTest, int version) {
  const vec2 at = (receiver.xy / receiver.z - tangentLow) / tangentSize * float(resolution);
  if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(float(resolution)))))) return false;
  const ivec2 mapTexel = ivec2(at);
  float nearest = 0.0;
  for (int layer = 0; layer < layerCount; ++layer)
    if (layer != leftOut) nearest = max(nearest, nearestIn(layer, mapTexel));
  for (int i = 0; i < testCount; ++i)
    if (tests[i].layer != leftOut)
      nearest = max(nearest, nearestIn(i == castTest ? version : tests[i].lightCurrent, mapTexel));
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution);
  const float slope = min(receiver.w, maxSlope * receiver.z);
  const float biased = receiver.z - bias * receiver.z - slopeBias * slope * texel;
  return linearDepth(nearest, lightNear) < biased;
}
#endif

// Which version of an object under test casts a shadow in sunShare().
int castTest = kNoTest, castVersion = 0;

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) {
#ifdef SHADOW
  vec2 plane;
  const vec4 receiver = receiverAt(seen.position, seen.normal, plane);
  // Averted from the light, or shadowed.
  return receiver.w < 0.0 || isShadowed(receiver, kNoLayer, castTest, castVersion) ? 0.0 : 1.0;
#else
  return 1.0;
#endif
}
#endif

// Colour of a surface, the background's if there is none. For `test` and `version` see isShadowed().
vec3 colourOf(Key key, ivec2 pixel, int test, int version) {
  castTest = test;
  castVersion = version;
  return shadedColour(pixel, key.depth == 0.0 ? 0xffffffffu : key.triangle);
}

// M_i: whether other layers shadow a surface of a layer. Surfaces turned away from the light are dark by themselves.
bool isMasked(Key key, ivec2 pixel, int layer) {
#ifdef SHADOW
  const uvec3 vertices = sceneTriangle(key.triangle);
  const SeenPoint seen = pointSeen((anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz,
                                   (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz,
                                   (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz,
                                   pixelRay(pixel, rayScale, sizePx));
  vec2 plane;
  const vec4 receiver = receiverAt(seen.position, seen.normal, plane);
  return receiver.w >= 0.0 && isShadowed(receiver, layer, kNoTest, 0);
#else
  return false;
#endif
}

// As perception::DisplayProfile::luminanceCdM2.
float luminanceCdM2(vec3 linearRgb) {
  const vec3 weights = vec3(0.2126729, 0.7151522, 0.0721750) / 1.0000001;
  // Written so that a NaN becomes 0.
  const vec3 light = mix(vec3(0.0), min(linearRgb, vec3(1e6)), greaterThan(linearRgb, vec3(0.0)));
  return blackCdM2 + rangeCdM2 * dot(weights, light);
}
