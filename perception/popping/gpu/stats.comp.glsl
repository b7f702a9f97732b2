// SPDX-License-Identifier: BSD-3-Clause
// Labels pixels and sums up regions. Each invocation walks down a column of ROWS pixels and hands on what it
// gathered when the region changes; what belongs to the group's most common region meets in shared memory first, so
// that few additions reach the table. Sums are integers: their order does not matter.
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/region_table.glsl"

layout(local_size_x = kStatsGroupX, local_size_y = kStatsGroupY) in;

layout(binding = kRegionJndUnit) uniform sampler2D jnd;
layout(binding = kRegionLabelsImage, r32ui) uniform writeonly uimage2D labels;

uniform float threshold, exponent;

shared uint leader;  // label of the region that is summed up in `tally`
shared RegionRecord tally;

struct Gathered {
  uint label, sizePx, sum[4], largestBits, leastY, mostY, ySum;
};

// Adds a to the 64-bit number low, high. Exact whatever else is added meanwhile, since each carry is handed on.
#define ADD_64(low, high, a)                  \
  {                                           \
    uint before = atomicAdd(low, a);          \
    if (before + (a) < before) atomicAdd(high, 1u); \
  }

#define ADD_TO(region, g, x)                                       \
  {                                                                \
    atomicAdd(region.sizePx, g.sizePx);                            \
    uint carry = 0u;                                               \
    for (int word = 0; word < 4; ++word) {                         \
      uint add = g.sum[word] + carry;                              \
      carry = add < carry ? 1u : 0u;                               \
      if (add == 0u) continue;                                     \
      uint before = atomicAdd(region.sum[word], add);              \
      if (before + add < before) carry += 1u;                      \
    }                                                              \
    atomicMax(region.largestBits, g.largestBits);                  \
    atomicMin(region.leastX, x);                                   \
    atomicMax(region.mostX, x);                                    \
    atomicMin(region.leastY, g.leastY);                            \
    atomicMax(region.mostY, g.mostY);                              \
    ADD_64(region.x0, region.x1, x * g.sizePx)                     \
    ADD_64(region.y0, region.y1, g.ySum)                           \
  }

void clearGathered(out Gathered g) { g = Gathered(0u, 0u, uint[4](0u, 0u, 0u, 0u), 0u, kNone, 0u, 0u); }

void handOn(inout Gathered g, uint x) {
  if (g.label == 0u) return;
  if (g.label == leader)
    ADD_TO(tally, g, x)
  else
    ADD_TO(regions[g.label - 1u], g, x)
}

// Adds value >= 1, rounded to 2^-16: its mantissa, shifted to its place.
void addFixed(inout uint sum[4], float value) {
  uint bits = floatBitsToUint(value);
  uint mantissa = (bits & 0x7fffffu) | 0x800000u;
  int shift = clamp(int(bits >> 23u) - 127 - 23 + 16, -23, 72);  // 72: saturates far beyond 2^80
  uint word = uint(max(shift, 0)) / 32u, offset = uint(max(shift, 0)) % 32u;
  uint low = shift < 0 ? (mantissa + (1u << uint(-shift - 1))) >> uint(-shift) : mantissa << offset;
  uint high = offset > 8u ? mantissa >> (32u - offset) : 0u;
  uint carry = 0u;
  for (uint i = word; i < 4u; ++i) {
    uint add = (i == word ? low : i == word + 1u ? high : 0u), before = sum[i];
    uint total = before + add;
    uint out1 = total < before ? 1u : 0u;
    total += carry;
    carry = out1 + (total < carry ? 1u : 0u);
    sum[i] = total;
  }
}

void main() {
  ivec2 size = textureSize(jnd, 0);
  uint index = gl_LocalInvocationIndex;
  if (index == 0u) {
    leader = kNone;
    tally = RegionRecord(0u, uint[4](0u, 0u, 0u, 0u), 0u, kNone, kNone, 0u, 0u, 0u, 0u, 0u, 0u, 0.0, 0.0);
  }
  barrier();
  int x = int(gl_GlobalInvocationID.x), top = int(gl_GlobalInvocationID.y) * kStatsRows;
  uint label[kStatsRows];
  uint first = 0u;
  for (int row = 0; row < kStatsRows; ++row) {
    label[row] = 0u;
    if (x >= size.x || top + row >= size.y) continue;
    uint root = parents[uint(top + row) * uint(size.x) + uint(x)];
    if (root != kNone) label[row] = roots[root];
    imageStore(labels, ivec2(x, top + row), uvec4(label[row]));
    if (first == 0u) first = label[row];
  }
  if (first != 0u) atomicMin(leader, first);
  barrier();
  if (leader == kNone) return;  // no region in the group

  Gathered g;
  clearGathered(g);
  if (first != 0u) {
    for (int row = 0; row < kStatsRows; ++row) {
      if (label[row] != g.label) {
        handOn(g, uint(x));
        clearGathered(g);
        g.label = label[row];
      }
      if (label[row] == 0u) continue;
      uint y = uint(top + row);
      float value = texelFetch(jnd, ivec2(x, y), 0).x;
      g.sizePx += 1u;
      addFixed(g.sum, pow(value / threshold, exponent));
      g.largestBits = max(g.largestBits, floatBitsToUint(value));
      g.leastY = min(g.leastY, y);
      g.mostY = max(g.mostY, y);
      g.ySum += y;
    }
    handOn(g, uint(x));
  }
  barrier();
  if (index != 0u) return;
  uint slot = leader - 1u;
  atomicAdd(regions[slot].sizePx, tally.sizePx);
  uint carry = 0u;
  for (int word = 0; word < 4; ++word) {
    uint add = tally.sum[word] + carry;
    carry = add < carry ? 1u : 0u;
    uint before = atomicAdd(regions[slot].sum[word], add);
    if (before + add < before) carry += 1u;
  }
  atomicMax(regions[slot].largestBits, tally.largestBits);
  atomicMin(regions[slot].leastX, tally.leastX);
  atomicMin(regions[slot].leastY, tally.leastY);
  atomicMax(regions[slot].mostX, tally.mostX);
  atomicMax(regions[slot].mostY, tally.mostY);
  ADD_64(regions[slot].x0, regions[slot].x1, tally.x0)
  atomicAdd(regions[slot].x1, tally.x1);
  ADD_64(regions[slot].y0, regions[slot].y1, tally.y0)
  atomicAdd(regions[slot].y1, tally.y1);
}
