// SPDX-License-Identifier: BSD-3-Clause
// How many samples of each pixel are shaded: from the geometry in its window and from the colours of the first samples
// around it (Holländer 2013, section 4.3.1).
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

uniform ivec2 sizePx;  // of the samples' image
#include "renderer/frame/surface_point.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampleIdsUnit) uniform usampler2D sampleIds;
layout(binding = kSampleFirstUnit) uniform sampler2D firstColours;
layout(binding = kSampleCountsImage, r32ui) uniform writeonly uimage2D outCounts;

uniform ivec2 pictureSizePx;
uniform float depthScale, normalScale, lightnessScale, leastRange, edgeShare;
uniform float nearest;  // distance that window depths are relative to

const int kSamples = WINDOW * WINDOW;
const uint kNothing = 0xffffffffu;
#include "renderer/techniques/antialiasing/window_metrics.glsl"

// Places in a window row by row, as neighbours often see the same triangle.
ivec2 windowPlace(int i) { return ivec2(i % WINDOW, i / WINDOW); }

float depthInTerms(float depth, float first) {
#if DEPTH_TERMS == DEPTH_TERMS_LINEAR
  return depth;
#elif DEPTH_TERMS == DEPTH_TERMS_WINDOW
  return nearest / depth;
#else
  return depth / first;
#endif
}

#ifdef MEASURE_DEPTH
// Range of the depths that the samples in the window's corners see of one triangle.
float cornerRange(ivec2 pixel, uint id) {
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = (anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz;
  const vec3 b = (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz;
  const vec3 c = (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz;
  const vec3 plane = planeNormal(a, b, c);
  float first = 1.0, low = 1.0, high = 1.0;
  for (int corner = 0; corner < 4; ++corner) {
    const ivec2 place = WINDOW * pixel + (WINDOW - 1) * ivec2(corner & 1, corner >> 1);
    const float depth = depthSeen(a, b, c, plane, pixelRay(place, rayScale, sizePx));
    if (corner == 0) first = depth;
    const float inTerms = depthInTerms(depth, first);
    low = corner == 0 ? inTerms : min(low, inTerms);
    high = corner == 0 ? inTerms : max(high, inTerms);
  }
  return high - low;
}
#endif

// Further samples that the geometry asks for; all if a surface ends at the background.
float geometryCount(ivec2 pixel) {
#if GEOMETRY == GEOMETRY_NONE
  return 0.0;
#else
  const uint first = texelFetch(sampleIds, WINDOW * pixel, 0).x;
  bool oneTriangle = true, background = first == kNothing;
  for (int i = 1; i < kSamples; ++i) {
    const uint id = texelFetch(sampleIds, WINDOW * pixel + windowPlace(i), 0).x;
    if (id == kNothing) background = true;
    if (id != first) oneTriangle = false;
  }
  if (background) return oneTriangle ? 0.0 : float(kSamples - 1);
#ifdef FLAT_TRIANGLES
#ifndef MEASURE_DEPTH
  if (oneTriangle) return 0.0;
#elif METRIC_FORM != METRIC_FORM_PRINTED
  if (oneTriangle) {
    // Depths on a plane are extreme at the window's corners.
    const float range = cornerRange(pixel, first);
#if GEOMETRY == GEOMETRY_MIN_MAX_DEPTH
    return depthScale * range;
#else
    // A variance is at most a quarter of the squared range (Popoviciu 1935).
    if (depthScale * 0.25 * range * range < 0.5) return 0.0;
#endif
  }
#endif
#endif
  uint ids[kSamples];
  for (int i = 0; i < kSamples; ++i) ids[i] = texelFetch(sampleIds, WINDOW * pixel + windowPlace(i), 0).x;
  float firstDepth = 1.0;
  float depths[kSamples];
  vec3 normals[kSamples];
#ifdef FLAT_TRIANGLES
  vec3 a, b, c, plane, normal;
  for (int i = 0; i < kSamples; ++i) {
    if (i == 0 || ids[i] != ids[i - 1]) {
      const uvec3 vertices = sceneTriangle(ids[i]);
      a = (anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz;
      b = (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz;
      c = (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz;
      plane = planeNormal(a, b, c);
      // One triangle's own normal does not matter.
      normal = vec3(0.0, 0.0, 1.0);
      if (!oneTriangle) {
        SeenPoint seen;
        normal = surfaceSeen(WINDOW * pixel + windowPlace(i), ids[i], seen).normal;
      }
    }
    const float depth = depthSeen(a, b, c, plane, pixelRay(WINDOW * pixel + windowPlace(i), rayScale, sizePx));
    if (i == 0) firstDepth = depth;
    depths[i] = depthInTerms(depth, firstDepth);
    normals[i] = normal;
  }
#else
  for (int i = 0; i < kSamples; ++i) {
    SeenPoint seen;
    normals[i] = surfaceSeen(WINDOW * pixel + windowPlace(i), ids[i], seen).normal;
    if (i == 0) firstDepth = seen.depth;
    depths[i] = depthInTerms(seen.depth, firstDepth);
  }
#endif
#if GEOMETRY == GEOMETRY_MIN_MAX_DEPTH
  return depthScale * depthRange(depths);
#elif GEOMETRY == GEOMETRY_NORMAL_CONE
  return normalScale * normalCone(normals);
#elif GEOMETRY == GEOMETRY_DEPTH_VARIANCE
  return depthScale * depthVariance(depths);
#elif GEOMETRY == GEOMETRY_NORMAL_VARIANCE
  return normalScale * normalVariance(normals);
#else
  return max(normalScale * normalCone(normals), depthScale * depthVariance(depths));
#endif
#endif
}

float luminanceAt(ivec2 pixel) {
  return dot(texelFetch(firstColours, clamp(pixel, ivec2(0), pictureSizePx - 1), 0).rgb, vec3(0.2126, 0.7152, 0.0722));
}

// Further samples that the light around the pixel asks for.
float lightnessCount(ivec2 pixel) {
#ifdef LIGHTNESS
  float least = luminanceAt(pixel), most = least;
  for (int i = 0; i < 4; ++i) {
    const float around = luminanceAt(pixel + ivec2(i == 0 ? 1 : i == 1 ? -1 : 0, i == 2 ? 1 : i == 3 ? -1 : 0));
    least = min(least, around);
    most = max(most, around);
  }
  const float range = most - least;
  return range < max(leastRange, most * edgeShare) ? 0.0 : lightnessScale * range;
#else
  return 0.0;
#endif
}

// A NaN asks for none.
uint furtherSamples(float asked) { return asked > 0.0 ? uint(min(asked + 0.5, float(kSamples - 1))) : 0u; }

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, pictureSizePx))) return;
  uint count = 1u + furtherSamples(lightnessCount(pixel));
  if (count < uint(kSamples)) count = max(count, 1u + furtherSamples(geometryCount(pixel)));
#ifdef POWERS_OF_TWO
  uint rounded = 1u;
  while (rounded < count) rounded *= 2u;
  count = min(rounded, uint(kSamples));
#endif
  imageStore(outCounts, pixel, uvec4(count, 0u, 0u, 0u));
}
