// SPDX-License-Identifier: BSD-3-Clause
// Visibility at every pixel from that on a coarser grid: bilinear weights times those of surface_weight.glsl. After DeCoro
// and Rusinkiewicz, as Schwarz 2009, section 5.1.3, describes it ("utilizing normal and position information").
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"
#include "renderer/frame/seen_point.glsl"
#include "renderer/techniques/soft_shadows/sparse/reconstructed_pixel.glsl"
#include "renderer/techniques/soft_shadows/sparse/surface_weight.glsl"

layout(binding = kSparseUpsampleGridReceiversUnit) uniform sampler2D gridReceivers;
layout(binding = kSparseUpsampleGridDepthsUnit) uniform sampler2D gridDepths;
layout(binding = kSparseUpsampleGridNormalsUnit) uniform sampler2D gridNormals;
layout(binding = kSparseUpsampleGridVisibilityUnit) uniform sampler2D gridVisibility;
uniform ivec2 gridSizePx;
// Sample i lies at min(firstPlace + i * placeStep, lastPlace), in pixels from the picture's top left corner.
uniform vec2 firstPlace, placeStep, lastPlace;

vec2 placeOf(ivec2 sampled) { return min(firstPlace + vec2(sampled) * placeStep, lastPlace); }

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  if (texelFetch(receivers, pixel, 0).w < 0.0) {
    store(pixel, 1.0, kClassNoReceiver);
    return;
  }
  const vec2 place = vec2(pixel) + 0.5;
  const vec3 point = placeRay(place, rayScale, sizePx) * texelFetch(depths, pixel, 0).x;
  const vec3 normal = cameraNormal(texelFetch(normals, pixel, 0));
  const ivec2 low = clamp(ivec2(floor((place - firstPlace) / placeStep)), ivec2(0), max(gridSizePx - 2, 0));
  const ivec2 high = min(low + 1, gridSizePx - 1);
  const vec2 apart = placeOf(high) - placeOf(low);
  const vec2 t = clamp((place - placeOf(low)) / max(apart, vec2(1e-6)), 0.0, 1.0);
  float sum = 0.0, total = 0.0;
  for (int i = 0; i < 4; ++i) {
    const ivec2 at = ivec2((i & 1) == 0 ? low.x : high.x, (i & 2) == 0 ? low.y : high.y);
    const float bilinear = ((i & 1) == 0 ? 1.0 - t.x : t.x) * ((i & 2) == 0 ? 1.0 - t.y : t.y);
    if (texelFetch(gridReceivers, at, 0).w < 0.0) continue;
    const vec3 other = placeRay(placeOf(at), rayScale, sizePx) * texelFetch(gridDepths, at, 0).x;
    const float near = depthWeight(planeDistance(point, normal, other)), visibility = texelFetch(gridVisibility, at, 0).x;
    if (bilinear == 1.0 && near > 0.0) {
      // The sample is this pixel's own: no weight may round it.
      store(pixel, visibility, kClassOwnSample);
      return;
    }
    const float weight = bilinear * near * normalWeight(normal, cameraNormal(texelFetch(gridNormals, at, 0)));
    sum += weight * visibility;
    total += weight;
  }
  if (total > kLeastWeight) {
    // Weights may round to a mean just outside of what was averaged.
    store(pixel, clamp(sum / total, 0.0, 1.0), kClassInterpolated);
    return;
  }
  // The four are surrounded by twelve more: of all of them, the nearest in depth.
  float nearest = 1e38, visibility = 1.0;
  for (int y = low.y - 1; y <= low.y + 2; ++y)
    for (int x = low.x - 1; x <= low.x + 2; ++x) {
      const ivec2 at = clamp(ivec2(x, y), ivec2(0), gridSizePx - 1);
      if (texelFetch(gridReceivers, at, 0).w < 0.0) continue;
      const float apartInDepth = abs(texelFetch(gridDepths, at, 0).x + point.z);
      if (apartInDepth < nearest) {
        nearest = apartInDepth;
        visibility = texelFetch(gridVisibility, at, 0).x;
      }
    }
  store(pixel, visibility, nearest < 1e38 ? kClassNearestInDepth : kClassNoSample);
}
