// SPDX-License-Identifier: BSD-3-Clause
// A bit for each light sample, set once an occluder covers the sample. Schwarz 2009, section 4.2.
// SAMPLE_PLACES: a grid of SAMPLES_ALONG samples a side, the jittered 16 x 16 grid, or SAMPLES that lie anywhere, whose
// masks are read from a table of RECTANGLES steps on either axis (rectangle_table.h).
//
// A rectangle (x0, y0, x1, y1) covers the samples with x0 < s <= x1 and likewise in y, so rectangles that share an
// edge neither skip nor double a sample. The thesis takes floor(16 v + 3/4) as the number of samples (i + 1/4) / 16 up to v; that
// sum rounds, and a bound just below a sample would count as on it. (floor(64 v) + 3) / 4, whole parts of integers, is exact.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

#define MASK_WORDS (SAMPLES / 32)

uint mask[MASK_WORDS];

// SHAPED_LIGHT: the light does not fill its rectangle, and LIGHT_SAMPLES of the samples lie on it, those whose bits are
// set in lightMask. The others count as covered from the start, so that a mask is full once the light is. Schwarz 2009,
// section 4.2.2.
#ifdef SHAPED_LIGHT
layout(std430, binding = kLightMaskBuffer) readonly buffer LightMask { uint lightMask[MASK_WORDS]; };
#else
#define LIGHT_SAMPLES SAMPLES
#endif

void clearMask() {
#ifdef SHAPED_LIGHT
  for (int i = 0; i < MASK_WORDS; ++i) mask[i] = ~lightMask[i];
#else
  for (int i = 0; i < MASK_WORDS; ++i) mask[i] = 0u;
#endif
}

void coverAll() {
  for (int i = 0; i < MASK_WORDS; ++i) mask[i] = 0xffffffffu;
}

// Bits [low, high), high <= 32; empty if high <= low. A shift by 32 is undefined, which bitfieldInsert avoids.
uint bitRange(int low, int high) { return bitfieldInsert(0u, 0xffffffffu, low, max(high - low, 0)); }

// Whole parts of count v, exact where the count is a power of two.
ivec4 steps(vec2 low, vec2 high, float count) { return ivec4(floor(vec4(low, high) * count)); }

#if SAMPLE_PLACES == SAMPLE_PLACES_ANYWHERE
layout(binding = kRectangleMasksUnit) uniform usampler2DArray rectangleMasks;

// Bounds are rounded to the table's steps, those of two rectangles at one edge alike.
void addToMask(vec2 low, vec2 high) {
  const ivec2 first = ivec2(roundEven(low * float(RECTANGLES))), end = ivec2(roundEven(high * float(RECTANGLES)));
  for (int layer = 0; layer < MASK_WORDS / 4; ++layer) {
    const uvec4 outside = texelFetch(rectangleMasks, ivec3(end.x, first.y, layer), 0) |
                          texelFetch(rectangleMasks, ivec3(first.x, end.y, layer), 0);
    const uvec4 inside = texelFetch(rectangleMasks, ivec3(end, layer), 0) & ~outside;
    for (int i = 0; i < 4; ++i) mask[4 * layer + i] |= inside[i];
  }
}
#elif SAMPLE_PLACES == SAMPLE_PLACES_JITTERED_GRID
// Sample (i, j) at x = (i + (j even ? 1/4 : 3/4)) / 16, y = (j + (i even ? 3/4 : 1/4)) / 16.
void addToMask(vec2 low, vec2 high) {
  const ivec4 quarters = steps(low, high, 64.0);
  const ivec4 upToQuarter = (quarters + 3) >> 2, upToThird = (quarters + 1) >> 2;
  const ivec2 lowQuarter = upToQuarter.xy, highQuarter = upToQuarter.zw, lowThird = upToThird.xy, highThird = upToThird.zw;
  // Even rows have x offset 1/4, odd rows 3/4: one word holds an even row and the odd row above it.
  const uint columns = bitRange(lowQuarter.x, highQuarter.x) | (bitRange(lowThird.x, highThird.x) << 16);
  // Two bits a row: whether its even columns' samples lie within, then its odd ones'.
  const uint rows = (bitRange(2 * lowThird.y, 2 * highThird.y) & 0x55555555u) |
                    (bitRange(2 * lowQuarter.y, 2 * highQuarter.y) & 0xaaaaaaaau);
  for (int k = 0; k < 8; ++k) {
    // Of rows 2 k and 2 k + 1: each one's two bits to the lowest of its half, then to all columns of their kind.
    const uint pair = (bitfieldExtract(rows, 4 * k, 4) * 0x4001u) & 0x00030003u;
    mask[k] |= (pair * 0x5555u) & columns;
  }
}
#else
void addToMask(vec2 low, vec2 high) {
  const ivec4 upTo = (steps(low, high, float(2 * SAMPLES_ALONG)) + 1) >> 1;
  const ivec2 first = upTo.xy, end = upTo.zw;
  const uint columns = bitRange(first.x, end.x), rows = bitRange(first.y, end.y);
#if SAMPLES_ALONG == 32
  for (int j = 0; j < 32; ++j) mask[j] |= columns & (0u - bitfieldExtract(rows, j, 1));
#elif SAMPLES_ALONG == 16
  // Spreads two bits to the lowest of either half.
  for (int k = 0; k < 8; ++k)
    mask[k] |= columns * ((bitfieldExtract(rows, 2 * k, 2) * 0x8001u) & 0x00010001u);
#else
  // Spreads four bits to the lowest of each byte.
  for (int k = 0; k < 2; ++k)
    mask[k] |= columns * ((bitfieldExtract(rows, 4 * k, 4) * 0x00204081u) & 0x01010101u);
#endif
}
#endif

int samplesCovered() {
  int covered = 0;
  for (int i = 0; i < MASK_WORDS; ++i) covered += bitCount(mask[i]);
  return covered;
}

// Share of the light's samples that are not covered.
float visibleShare() { return float(SAMPLES - samplesCovered()) / float(LIGHT_SAMPLES); }

bool allCovered() {
  uint all = 0xffffffffu;
  for (int i = 0; i < MASK_WORDS; ++i) all &= mask[i];
  return all == 0xffffffffu;
}
