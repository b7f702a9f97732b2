// SPDX-License-Identifier: BSD-3-Clause
// The surfaces of a frame's regions, and the light on them: layers, and the versions of the objects under test.
#include "renderer/frame/receiver_plane.glsl"
#include "renderer/frame/shaded_surface.glsl"
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"
#include "renderer/techniques/perceptual_lod/surface_key.glsl"
#ifdef SHADOW
#include "renderer/frame/shadow_depth.glsl"
#include "renderer/frame/shadow_lookup.glsl"
#endif

layout(std140, binding = kRasterRegionsBlock) uniform Regions { RasterRegion regions[kMostRasterRegions]; };
layout(std140, binding = kPlannedTestsBlock) uniform PlannedTests { PlannedTest tests[kMostTests]; };
layout(std430, binding = kGatheredBuffer) readonly buffer Gathered { uint gathered[]; };

uniform int layerCount, testCount;
uniform mat4 cameraToLight;
uniform float lightNear;
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

vec4 receiverOf(SurfaceSeen s) {
  const vec3 p = (cameraToLight * vec4(s.at.position, 1.0)).xyz;
  return receiverAt(p, mat3(cameraToLight) * s.at.normal);
}

#ifdef SHADOW
float nearestIn(int index, ivec2 texel) {
  const int place = placeIn(regions[index], texel);
  return place < 0 ? 0.0 : uintBitsToFloat(gathered[regions[index].at + place]);
}

// Whether a receiver is shadowed by what casts shadows outside `leftOut`, one object under test being cast with region
// `version` in place of its current level.
bool isShadowed(vec4 receiver, int leftOut, int test, int version) {
  const ShadowLookup lookup = shadowLookup(receiver);
  if (!lookup.inMap) return false;
  float nearest = 0.0;
  for (int layer = 0; layer < layerCount; ++layer)
    if (layer != leftOut) nearest = max(nearest, nearestIn(layer, lookup.texel));
  for (int i = 0; i < testCount; ++i)
    if (tests[i].layer != leftOut)
      nearest = max(nearest, nearestIn(i == test ? version : tests[i].lightCurrent, lookup.texel));
  return linearDepth(nearest, lightNear) < lookup.biased;
}
#endif

// Colour of a surface, the background's if there is none. For `test` and `version` see isShadowed().
vec3 colourOf(Key key, ivec2 pixel, int test, int version) {
  if (key.depth == 0.0) return background;
  const SurfaceSeen s = surfaceSeen(key.triangle, pixel);
  float lit = 1.0;
#ifdef SHADOW
  const vec4 receiver = receiverOf(s);
  lit = receiver.w < 0.0 || isShadowed(receiver, kNoLayer, test, version) ? 0.0 : 1.0;
#endif
  return surfaceColour(key.triangle, s, lit);
}

// M_i: whether other layers shadow a surface of a layer. Surfaces turned away from the light are dark by themselves.
bool isMasked(Key key, ivec2 pixel, int layer) {
#ifdef SHADOW
  const vec4 receiver = receiverOf(surfaceSeen(key.triangle, pixel));
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
