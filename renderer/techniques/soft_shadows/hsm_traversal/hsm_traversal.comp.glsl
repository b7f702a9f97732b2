// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#ifdef BITMASK
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"
#include "renderer/techniques/soft_shadows/bitmask/mask_rows.glsl"
#include "renderer/techniques/soft_shadows/bitmask/hidden_samples.glsl"
#else
#include "renderer/techniques/soft_shadows/plane_share.glsl"
float hiddenArea = 0.0, frontShare = 1.0;
#endif

layout(binding = kMinimumMapUnit) uniform sampler2D minimumMap;  // level 0: the linear shadow map
layout(binding = kMaximumMapUnit) uniform sampler2D maximumMap;  // its level i is the pyramid's level i + 1

uniform int levels, finestLevel;
uniform int maxIterations;  // that the driver's compiler allows

#ifdef BLOCKS
#if BLOCK_DEPTH == BLOCK_DEPTH_MINIMUM
#define BLOCK_AT nearest
#elif BLOCK_DEPTH == BLOCK_DEPTH_MAXIMUM
#define BLOCK_AT farthest
#else
#define BLOCK_AT (0.5 * (nearest + farthest))
#endif
#endif

bool isSaturated() {
#ifdef BITMASK
  return allCovered();
#else
  return hiddenArea >= 1.0;
#endif
}

#ifdef BIAS_PLANE
// Least and largest of 1 + g . (t - t_p) over the centres of a tile's texels: depth times this is what the receiver's plane
// compares with.
vec2 planeFactors(vec2 low, vec2 high, vec2 perTexel, vec2 centre) {
  const float middle = 1.0 + dot(receiverPlane, 0.5 * (low + high) - centre);
  const float reach = 0.5 * dot(abs(receiverPlane), high - low - perTexel);
  return vec2(middle - reach, middle + reach);
}
#endif

// Tile [low, high) in tangents at depth z, backprojected as in micropatches.glsl.
void addTile(vec2 low, vec2 high, float z, vec4 p) {
  const float projectionScaleOfTile = z / (p.z - z) * p.z;
  const vec2 centre = p.xy / p.z;
  const vec2 from = projectionScaleOfTile * (low - centre) / lightSize + 0.5, to = projectionScaleOfTile * (high - centre) / lightSize + 0.5;
  // In an order that turns a NaN into a bound.
  const vec2 a = min(max(from, vec2(0.0)), vec2(1.0)), b = min(max(to, vec2(0.0)), vec2(1.0));
  ++occluderCount;
  if (!(a.x < b.x && a.y < b.y)) return;
  ++usedCount;
#ifdef BITMASK
  addToMask(a, b);
#else
  hiddenArea += (b.x - a.x) * (b.y - a.y);
#endif
}

float gathered() {
#ifdef BITMASK
  return 1.0 - float(samplesCovered()) / float(SAMPLES);
#else
  // As in backprojection: areas cannot tell whether an occluder and the plane hide the same part.
  return frontShare * (1.0 - min(hiddenArea, 1.0));
#endif
}

float visibilityOf(vec4 p, ivec2 pixel) {
#ifdef BITMASK
  clearMask();
  hideBehindPlane(p);
#else
  frontShare = shareBeforePlane(p);
#endif
#ifdef BIAS_PLANE
  const float limit = p.z * (1.0 - planeMargin(slopeBias));
#endif
  const int root = levels - 1;
  const float depth = biasedDepth(p, finestLevel);
  const vec2 perTexel = tangentSize / float(resolution), centre = p.xy / p.z;
  // The pyramid's section at depth z is this times 1 / z - 1 / p.z to either side of `centre`.
  const vec2 halfLight = 0.5 * lightSize;
  pixelClass = kLit;
  ivec2 tile = ivec2(0);
  int level = root;
  for (int visited = 0;; ++visited) {
    if (visited >= maxIterations) {
      pixelClass = kCutShort;
      return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
    }
    ++examinedCount;
    ++fetchCount;
    const float nearest = texelFetch(minimumMap, tile, level).x;
    bool descend = false;
    if (nearest < depth) {
      const vec2 low = tangentLow + vec2(tile << level) * perTexel, high = tangentLow + vec2((tile + 1) << level) * perTexel;
      const vec2 reach = halfLight * (1.0 / nearest - 1.0 / p.z);
      const bool meets = all(lessThan(low, centre + reach)) && all(greaterThan(high, centre - reach));
#ifdef BIAS_PLANE
      const vec2 factors = planeFactors(low, high, perTexel, centre);
      const bool mayBlock = nearest * factors.x < limit;
#else
      const bool mayBlock = true;
#endif
      if (meets) {
        pixelClass = kProcessed;
        if (!mayBlock) {
          // behind the receiver's plane, whatever its texels are
        } else if (level <= finestLevel) {
#ifdef BIAS_PLANE
          // The nearest depth is that of any of the tile's texels.
          const float spread = 0.5 * float((1 << level) - 1);
          if (nearest * 0.5 * (factors.x + factors.y) < p.z * (1.0 - planeMargin(slopeBias + spread)))
#endif
          addTile(low, high, nearest, p);
        } else {
          descend = true;
#ifdef BLOCKS
          ++fetchCount;
          const float farthest = texelFetch(maximumMap, tile, level - 1).x;
#ifdef BIAS_PLANE
          if (farthest < depth && farthest * factors.y < limit) {
#else
          if (farthest < depth) {
#endif
            const vec2 least = halfLight * (1.0 / farthest - 1.0 / p.z);
            if (all(greaterThanEqual(low, centre - least)) && all(lessThanEqual(high, centre + least))) {
              addTile(low, high, BLOCK_AT, p);
              levelUsed = max(levelUsed, uint(level));
              descend = false;
            }
          }
#endif
        }
      } else if (level == root) {
        pixelClass = kOutside;
      }
    }
    if (descend) {
      tile <<= 1;
      --level;
      continue;
    }
    if (isSaturated()) return 0.0;
    // The next tile in Z order that is no part of this one: the thesis's stack of siblings still to visit, spelled in the
    // digits of the tile's place.
    while (level < root && (tile.x & tile.y & 1) == 1) {
      tile >>= 1;
      ++level;
    }
    if (level == root) break;
    tile = (tile.x & 1) == 0 ? tile + ivec2(1, 0) : tile + ivec2(-1, 1);
  }
  return gathered();
}
