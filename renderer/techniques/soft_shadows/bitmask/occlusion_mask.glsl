// SPDX-License-Identifier: BSD-3-Clause
// A bit for each light sample, set once an occluder covers the sample. Schwarz 2009, section 4.2.
// SAMPLE_PLACES: a grid of SAMPLES_ALONG samples a side, the jittered 16 x 16 grid, or SAMPLES that lie anywhere, whose
// masks are read from a table of RECTANGLES steps on either axis (rectangle_table.h).
//
// A rectangle (x0, y0, x1, y1) covers the samples with x0 < s <= x1 and likewise in y, so rectangles that share an
// edge neither skip nor double a sample. The thesis takes floor(16 v + 3/4); here the fraction is compared instead,
// because that sum rounds, and a bound just below a sample would then count as on it.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

#define MASK_WORDS (SAMPLES / 32)

// SHARED_MASKS: the LANES invocations that share a pixel have one mask in shared memory, to which all add.
#ifdef SHARED_MASKS
shared uint sharedMasks[MASK_WORDS][kWorkListGroup / LANES];
int maskSlot = 0;  // of this invocation's pixel
int maskLane = 0;  // of this invocation among those of its pixel, which share the work on words and rows
#define MASK_LANES LANES
uint maskWord(int i) { return sharedMasks[i][maskSlot]; }
void coverSamples(int word, uint samples) {
  if (samples != 0u) atomicOr(sharedMasks[word][maskSlot], samples);
}
void setMaskWord(int i, uint samples) { sharedMasks[i][maskSlot] = samples; }
#else
uint mask[MASK_WORDS];
const int maskLane = 0;
#define MASK_LANES 1
uint maskWord(int i) { return mask[i]; }
void coverSamples(int word, uint samples) { mask[word] |= samples; }
void setMaskWord(int i, uint samples) { mask[i] = samples; }
#endif

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
  for (int i = maskLane; i < MASK_WORDS; i += MASK_LANES) setMaskWord(i, ~lightMask[i]);
#else
  for (int i = maskLane; i < MASK_WORDS; i += MASK_LANES) setMaskWord(i, 0u);
#endif
}

void coverAll() {
  for (int i = maskLane; i < MASK_WORDS; i += MASK_LANES) setMaskWord(i, 0xffffffffu);
}

// Bits [low, high), high <= 32; empty if high <= low. A shift by 32 is undefined, which bitfieldInsert avoids.
uint bitRange(int low, int high) { return bitfieldInsert(0u, 0xffffffffu, low, max(high - low, 0)); }

// Number of samples (i + offset) / n at or below v: floor(n v - offset) + 1, exactly.
ivec2 samplesUpTo(vec2 v, float n, float offset) {
  const vec2 scaled = v * n, whole = floor(scaled);
  return ivec2(whole) + ivec2(greaterThanEqual(scaled - whole, vec2(offset)));
}

#if SAMPLE_PLACES == SAMPLE_PLACES_ANYWHERE
layout(binding = kRectangleMasksUnit) uniform usampler2DArray rectangleMasks;

// Bounds are rounded to the table's steps, those of two rectangles at one edge alike.
void addToMask(vec2 low, vec2 high) {
  const ivec2 first = ivec2(roundEven(low * float(RECTANGLES))), end = ivec2(roundEven(high * float(RECTANGLES)));
  for (int layer = 0; layer < MASK_WORDS / 4; ++layer) {
    const uvec4 outside = texelFetch(rectangleMasks, ivec3(end.x, first.y, layer), 0) |
                          texelFetch(rectangleMasks, ivec3(first.x, end.y, layer), 0);
    const uvec4 inside = texelFetch(rectangleMasks, ivec3(end, layer), 0) & ~outside;
    for (int i = 0; i < 4; ++i) coverSamples(4 * layer + i, inside[i]);
  }
}
#else
#if SAMPLE_PLACES == SAMPLE_PLACES_JITTERED_GRID
const int kRowBits = 4;  // of a word: its rows, or two for each
// Bits of a rectangle's columns as they stand in a word, and of its rows one after another.
//
// Sample (i, j) at x = (i + (j even ? 1/4 : 3/4)) / 16, y = (j + (i even ? 3/4 : 1/4)) / 16.
void rectangleBits(vec2 low, vec2 high, out uint columns, out uint rows) {
  const ivec2 lowQuarter = samplesUpTo(low, 16.0, 0.25), highQuarter = samplesUpTo(high, 16.0, 0.25);
  const ivec2 lowThird = samplesUpTo(low, 16.0, 0.75), highThird = samplesUpTo(high, 16.0, 0.75);
  // Even rows have x offset 1/4, odd rows 3/4: one word holds an even row and the odd row above it.
  columns = bitRange(lowQuarter.x, highQuarter.x) | (bitRange(lowThird.x, highThird.x) << 16);
  // Two bits a row: whether its even columns' samples lie within, then its odd ones'.
  rows = (bitRange(2 * lowThird.y, 2 * highThird.y) & 0x55555555u) |
         (bitRange(2 * lowQuarter.y, 2 * highQuarter.y) & 0xaaaaaaaau);
}
// A word's samples in these columns and rows of it.
uint samplesOf(uint columns, uint rows) {
  // Of rows 2 k and 2 k + 1: each one's two bits to the lowest of its half, then to all columns of their kind.
  const uint pair = (rows * 0x4001u) & 0x00030003u;
  return (pair * 0x5555u) & columns;
}
#else
const int kRowBits = 32 / SAMPLES_ALONG;
void rectangleBits(vec2 low, vec2 high, out uint columns, out uint rows) {
  const ivec2 first = samplesUpTo(low, float(SAMPLES_ALONG), 0.5), end = samplesUpTo(high, float(SAMPLES_ALONG), 0.5);
  columns = bitRange(first.x, end.x);
  rows = bitRange(first.y, end.y);
}
uint samplesOf(uint columns, uint rows) {
#if SAMPLES_ALONG == 32
  return columns & (0u - rows);
#elif SAMPLES_ALONG == 16
  return columns * ((rows * 0x8001u) & 0x00010001u);  // rows' bits to the lowest of either half
#else
  return columns * ((rows * 0x00204081u) & 0x01010101u);  // of each byte
#endif
}
#endif

void addToMask(vec2 low, vec2 high) {
  uint columns, rows;
  rectangleBits(low, high, columns, rows);
#ifdef SHARED_MASKS
  if (columns == 0u) return;
  // Only words with a row of the rectangle.
  while (rows != 0u) {
    const int k = findLSB(rows) / kRowBits;
    coverSamples(k, samplesOf(columns, bitfieldExtract(rows, kRowBits * k, kRowBits)));
    rows = bitfieldInsert(rows, 0u, kRowBits * k, kRowBits);
  }
#else
  for (int k = 0; k < MASK_WORDS; ++k) mask[k] |= samplesOf(columns, bitfieldExtract(rows, kRowBits * k, kRowBits));
#endif
}
#endif

int samplesCovered() {
  int covered = 0;
  for (int i = 0; i < MASK_WORDS; ++i) covered += bitCount(maskWord(i));
  return covered;
}

// Share of the light's samples that are not covered.
float visibleShare() { return float(SAMPLES - samplesCovered()) / float(LIGHT_SAMPLES); }

bool allCovered() {
  uint all = 0xffffffffu;
  for (int i = 0; i < MASK_WORDS; ++i) all &= maskWord(i);
  return all == 0xffffffffu;
}
