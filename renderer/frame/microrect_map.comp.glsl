// SPDX-License-Identifier: BSD-3-Clause
// One level of microrects from the level below. Schwarz 2009, section 4.5.2. Every other microrect on both axes is kept; the
// first pass has each kept one take what it wants of its neighbours up the axes, the second one what is left of those down
// them. The letters are those of the thesis's figure 4.27, for the one kept at A:
//   G H I
//   D E F
//   A B C
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kMicrorectMinimumMapUnit) uniform sampler2D minimumMap;    // its level 0 is the shadow map
layout(binding = kMicrorectDepthsUnit) uniform sampler2D rectDepths;    // its level i is level i + 1 of the microrects
layout(binding = kMicrorectExtentsUnit) uniform usampler2D rectExtents;
#ifdef FIRST_PASS
layout(binding = kMicrorectMergedImage, rgba16ui) uniform writeonly uimage2D outMerged;
#else
layout(binding = kMicrorectMergedUnit) uniform usampler2D merged;
layout(binding = kMicrorectDepthsImage, r32f) uniform writeonly image2D outDepths;
layout(binding = kMicrorectExtentsImage, rgba16ui) uniform writeonly uimage2D outExtents;
#endif
uniform int sourceLevel, size;  // level below; microrects along a side of the level that is made

// An extent takes 12 bits for the largest map of 4096; the first pass says in the top bits of x and y whether a microrect
// takes its B and D, and in those of z (low) and w (high) which of its A, C, G and I takes its E.
const uint kTaken = 0x8000u, kExtentMask = 0x7fffu;
const uint kTakenByA = 0u, kTakenByC = 1u, kTakenByG = 2u, kTakenByI = 3u;

uint takerOf(uvec4 first) { return (first.z >> 15) | ((first.w >> 15) << 1); }

float depthAt(ivec2 at) {
  return sourceLevel == 0 ? texelFetch(minimumMap, at, 0).x : texelFetch(rectDepths, at, sourceLevel - 1).x;
}

// Texels of level 0, all four bounds inclusive.
struct Box {
  ivec2 low, high;
};

Box boxAt(ivec2 at) {
  const ivec2 reference = at << sourceLevel;
  if (sourceLevel == 0) return Box(reference, reference);
  const ivec4 extent = ivec4(texelFetch(rectExtents, at, sourceLevel - 1));
  return Box(reference - extent.xy, reference + extent.zw);
}

void take(inout Box box, ivec2 at) {
  const Box other = boxAt(at);
  box.low = min(box.low, other.low);
  box.high = max(box.high, other.high);
}

// Extents around the reference texel of the microrect kept at `at`.
uvec4 extentsOf(Box box, ivec2 at) {
  const ivec2 reference = at << sourceLevel;
  return uvec4(reference - box.low, box.high - reference);
}

#ifdef FIRST_PASS
// Whether what lies between two kept microrects is nearer in depth to the first one. With a tie the second one gets it.
bool prefers(float own, float between, float other) {
#ifdef RELATIVE
  // |own - between| / min(own, between), and likewise for the other, without a division that devices round differently.
  precise float toOwn = abs(between - own) * min(between, other);
  precise float toOther = abs(between - other) * min(between, own);
#else
  precise float toOwn = abs(between - own);
  precise float toOther = abs(between - other);
#endif
  return toOwn < toOther;
}

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, ivec2(size)))) return;
  const ivec2 kept = 2 * at;
  const bool lastColumn = at.x == size - 1, lastRow = at.y == size - 1;
  const float own = depthAt(kept);
  Box box = boxAt(kept);
  const bool takesB =
      lastColumn || prefers(own, depthAt(kept + ivec2(1, 0)), depthAt(kept + ivec2(2, 0)));
  const bool takesD = lastRow || prefers(own, depthAt(kept + ivec2(0, 1)), depthAt(kept + ivec2(0, 2)));
  if (takesB) take(box, kept + ivec2(1, 0));
  if (takesD) take(box, kept + ivec2(0, 1));
  const float between = depthAt(kept + 1), c = lastColumn ? 0.0 : depthAt(kept + ivec2(2, 0));
  const float g = lastRow ? 0.0 : depthAt(kept + ivec2(0, 2));
  const bool atBorder = lastColumn || lastRow;
  uint taker = atBorder ? kTakenByA : kTakenByI;
#ifdef NEAREST_DIAGONAL
  float nearest = atBorder ? own : depthAt(kept + 2);
  if (prefers(own, between, nearest)) {
    taker = kTakenByA;
    nearest = own;
  }
  if (!lastColumn && prefers(c, between, nearest)) {
    taker = kTakenByC;
    nearest = c;
  }
  if (!lastRow && prefers(g, between, nearest)) taker = kTakenByG;
#else
  const Box diagonal = boxAt(kept + 1);
  if (all(greaterThanEqual(diagonal.low, box.low)) && all(lessThanEqual(diagonal.high, box.high)))
    taker = kTakenByA;
  else if (lastRow && !lastColumn && !prefers(own, between, c))
    taker = kTakenByC;
  else if (lastColumn && !lastRow && !prefers(own, between, g))
    taker = kTakenByG;
#endif
  if (taker == kTakenByA) take(box, kept + 1);
  uvec4 result = extentsOf(box, kept);
  if (takesB) result.x |= kTaken;
  if (takesD) result.y |= kTaken;
  result.zw |= uvec2(taker & 1u, taker >> 1) * kTaken;
  imageStore(outMerged, at, result);
}
#else
void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, ivec2(size)))) return;
  const ivec2 kept = 2 * at, reference = kept << sourceLevel;
  const uvec4 first = texelFetch(merged, at, 0);
  const ivec4 extent = ivec4(first & kExtentMask);
  Box box = Box(reference - extent.xy, reference + extent.zw);
  float depth = depthAt(kept);
  if ((first.x & kTaken) != 0u) depth = min(depth, depthAt(kept + ivec2(1, 0)));
  if ((first.y & kTaken) != 0u) depth = min(depth, depthAt(kept + ivec2(0, 1)));
  if (takerOf(first) == kTakenByA) depth = min(depth, depthAt(kept + 1));
  // Seen from those down the axes, where this one is their C, G or I: H of the one to the left, F of the one below, and of
  // all three the E.
  for (int i = 1; i < 4; ++i) {
    const ivec2 back = ivec2(i & 1, i >> 1), neighbour = at - back;
    if (any(lessThan(neighbour, ivec2(0)))) continue;
    const uvec4 theirs = texelFetch(merged, neighbour, 0);
    const bool onAxis = i < 3, taken = ((i == 1 ? theirs.x : theirs.y) & kTaken) != 0u;
    if (onAxis && !taken) {
      take(box, kept - back);
      depth = min(depth, depthAt(kept - back));
    }
    if (takerOf(theirs) == uint(i)) {
      const ivec2 diagonal = 2 * neighbour + 1;
      take(box, diagonal);
      depth = min(depth, depthAt(diagonal));
    }
  }
  imageStore(outDepths, at, vec4(depth));
  imageStore(outExtents, at, extentsOf(box, kept));
}
#endif
