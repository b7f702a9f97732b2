// SPDX-License-Identifier: BSD-3-Clause
// Chooses the pixels that get a visibility of their own, the fewer the wider the penumbra appears on the screen, and lists
// them. Schwarz 2009, section 5.1.3, after Guennebaud et al. 2007; the estimate and the pattern are reconstructed.
//
// A penumbra between the nearest blocker z_b and the receiver z is w (z - z_b) / z_b wide. That, seen by the camera, is its
// footprint; a pixel stands for the others of a square of 2^l pixels as long as `minSamples` squares fit the footprint.
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"
#include "renderer/frame/seen_point.glsl"
#include "renderer/frame/shadow_depth.glsl"
#include "renderer/techniques/soft_shadows/sparse/surface_weight.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSparseReceiversUnit) uniform sampler2D receivers;
layout(binding = kSparseDepthsUnit) uniform sampler2D depths;
layout(binding = kSparseNormalsUnit) uniform sampler2D normals;
layout(binding = kSparseChooseIdsUnit) uniform usampler2D triangleIds;
layout(binding = kSparseChooseMinimumMapUnit) uniform sampler2D minimumMap;
layout(binding = kSparseChooseIdsImage, r32ui) uniform writeonly uimage2D outIds;
layout(binding = kSparseChoosePlacesImage, rg32f) uniform writeonly image2D outPlaces;
layout(binding = kSparseChooseSlotsImage, r32ui) uniform writeonly uimage2D outSlots;
layout(std430, binding = kSparseChooseCountsBuffer) buffer Counts { uint listed; };

uniform ivec2 sizePx;
uniform int tilesPerRow;  // of the list's frame
uniform vec2 rayScale;
uniform float pixelsPerUnit;  // pixels that a length of 1 covers at distance 1, seen at right angles
uniform vec2 tangentLow, tangentSize, lightSize;
uniform float near, bias, slopeBias, maxSlope;
uniform int resolution, mapLevels;
uniform float minSamples;
uniform int coarsest;  // largest l

const int kReadPerAxis = 4;  // texels of the pyramid that an area is looked up in, at most one more

shared uint groupCount, groupFirst;

vec2 mapTexel(vec2 tangent) { return (tangent - tangentLow) / tangentSize * float(resolution); }

float biasedDepth(vec4 p) {
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution);
  return p.z - bias * p.z - slopeBias * min(p.w, maxSlope * p.z) * texel;
}

// Smallest width of a penumbra at the receiver, from the blocker nearest to it that the search area's minima show; 0 if
// none does.
float penumbraWidth(vec4 p) {
  const float nearest = max(near, texelFetch(minimumMap, ivec2(0), mapLevels - 1).x), limit = biasedDepth(p);
  if (nearest >= limit) return 0.0;
  const vec2 halfSize = 0.5 * lightSize * max(1.0 / nearest - 1.0 / p.z, 0.0);
  const ivec2 low = clamp(ivec2(floor(mapTexel(p.xy / p.z - halfSize))), ivec2(0), ivec2(resolution - 1));
  const ivec2 high = clamp(ivec2(floor(mapTexel(p.xy / p.z + halfSize))), ivec2(0), ivec2(resolution - 1));
  const int extent = max(high.x - low.x, high.y - low.y) / kReadPerAxis;
  const int level = min(extent > 0 ? findMSB(extent) + 1 : 0, mapLevels - 1);
  float blocker = 0.0;
  for (int y = low.y >> level; y <= high.y >> level; ++y)
    for (int x = low.x >> level; x <= high.x >> level; ++x) {
      const float z = texelFetch(minimumMap, ivec2(x, y), level).x;
      if (z < limit) blocker = max(blocker, z);
    }
  return blocker > 0.0 ? min(lightSize.x, lightSize.y) * (p.z - blocker) / blocker : 0.0;
}

vec3 pointAt(ivec2 pixel) { return pixelRay(pixel, rayScale, sizePx) * texelFetch(depths, pixel, 0).x; }

// Coarsest level up to `level` at which the corners of the pixel's square lie on its surface: across an edge, no pixel stands
// for another.
int levelWithinSurface(ivec2 pixel, int level) {
  const vec3 point = pointAt(pixel), normal = cameraNormal(texelFetch(normals, pixel, 0));
  for (; level > 0; --level) {
    const ivec2 low = (pixel >> level) << level;
    bool inside = true;
    for (int i = 0; i < 4; ++i) {
      const ivec2 corner = min(low + (ivec2(i & 1, i >> 1) << level), sizePx - 1);
      inside = inside && texelFetch(receivers, corner, 0).w >= 0.0 &&
               planeDistance(point, normal, pointAt(corner)) < 1.0;
    }
    if (inside) break;
  }
  return level;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (gl_LocalInvocationIndex == 0u) groupCount = 0u;
  barrier();
  bool chosen = false;
  int level = 0;
  if (all(lessThan(pixel, sizePx))) {
    const vec4 p = texelFetch(receivers, pixel, 0);
    if (p.w >= 0.0) {
      const float footprint = penumbraWidth(p) * pixelsPerUnit / texelFetch(depths, pixel, 0).x;
      const float side = footprint / minSamples;
      level = side >= 2.0 ? min(int(floor(log2(side))), coarsest) : 0;
      level = levelWithinSurface(pixel, level);
      chosen = (pixel & ((1 << level) - 1)) == ivec2(0);
    }
  }
  // One request a group: pixels that are neighbours on the screen stay so in the list.
  const uint place = chosen ? atomicAdd(groupCount, 1u) : 0u;
  barrier();
  if (gl_LocalInvocationIndex == 0u && groupCount > 0u) groupFirst = atomicAdd(listed, groupCount);
  barrier();
  if (any(greaterThanEqual(pixel, sizePx))) return;
  if (!chosen) {
    imageStore(outSlots, pixel, uvec4(kSkippedSlot | uint(level)));
    return;
  }
  const uint slot = groupFirst + place, tile = slot / 64u, within = slot % 64u;
  const uvec2 at = 8u * uvec2(tile % uint(tilesPerRow), tile / uint(tilesPerRow)) + uvec2(within % 8u, within / 8u);
  imageStore(outSlots, pixel, uvec4(at.x | (at.y << 16)));
  imageStore(outIds, ivec2(at), texelFetch(triangleIds, pixel, 0));
  imageStore(outPlaces, ivec2(at), vec4(vec2(pixel) + 0.5, 0.0, 0.0));
}
