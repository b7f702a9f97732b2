// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#define SUMS_UNIT kAveragesUnit
#ifdef MIPS
layout(binding = kAveragesUnit) uniform sampler2DArray averages;
#else
#include "renderer/frame/summed_area_table.glsl"
#endif

uniform int slices;
uniform float sliceBegin, sliceDepth;

// Share of [low, high), texels on the map, that slice k covers.
float coverage(vec2 low, vec2 high, int k) {
#ifdef MIPS
  const vec2 size = max(high - low, vec2(1.0));
  fetchCount += 8u;
  return textureLod(averages, vec3(0.5 * (low + high) / float(resolution), float(k)), 0.5 * log2(size.x * size.y)).x;
#else
  fetchCount += kSumFetches;
  return boxSum(low, high, k).x / ((high.x - low.x) * (high.y - low.y));
#endif
}

float visibilityOf(vec4 receiver, ivec2 pixel) {
  const vec2 centre = mapTexel(receiver.xy / receiver.z);
  const vec2 texelsPerTangent = float(resolution) / tangentSize;
  const float depth = biasedDepth(receiver, 0);
  pixelClass = kOutside;
  float visibility = 1.0;
  for (int k = 0; k < slices; ++k) {
    // What lies in a slice is taken to lie in its far plane: of the receiver's own slice nothing is before it.
    const float z = sliceBegin + float(k + 1) * sliceDepth;
    if (!(z < depth)) break;
    const vec2 size = max(lightSize * (1.0 / z - 1.0 / receiver.z) * texelsPerTangent, vec2(1.0));
    const vec2 low = clamp(centre - 0.5 * size, vec2(0.0), vec2(float(resolution)));
    const vec2 high = clamp(centre + 0.5 * size, vec2(0.0), vec2(float(resolution)));
    const vec2 inside = (high - low) / size;
    if (!(inside.x * inside.y > 0.0)) continue;
    pixelClass = kProcessed;
    const float covered = coverage(low, high, k);
    ++occluderCount;
    usedCount += covered > 0.0 ? 1u : 0u;
    visibility *= clamp(1.0 - inside.x * inside.y * covered, 0.0, 1.0);
  }
  examinedCount = occluderCount;
  return visibility;
}
