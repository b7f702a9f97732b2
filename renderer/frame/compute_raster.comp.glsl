// SPDX-License-Identifier: BSD-3-Clause
// Triangles into a depth image, or (IDS) into the indices of those that won. See compute_raster.h.
// Without LARGE: SMALL_LANES invocations a triangle, which share its pixels if its bounding box has at most SMALL_PIXELS; all
// others are queued in bands of rows. LISTED: triangles whose number only the GPU knows; FEW_LANES and FEW_PIXELS if they are few. With LARGE: the queue, a group a band. REGIONS: several rectangles in one buffer, each with
// triangles of its own; see region_raster.h. SAMPLES: instead of pixels' centres, the samples of pixels that may see several
// triangles; see sample_raster.h. MARKED: of pixels that are listed already. KEEP: lists the small triangles that reach into
// marked tiles and queues the others; KEPT: these small triangles alone. PACKED: depth and index at once, in 64 bits; SHARES: beside another scene's triangles.
#ifdef PACKED
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_NV_shader_atomic_int64 : require
#endif
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/raster_regions.h"
#include "renderer/frame/raster_triangle.glsl"

#ifndef SMALL_LANES
#define SMALL_LANES 1
#define SMALL_PIXELS 32
#endif

layout(local_size_x = kRasterGroup) in;
#ifdef REGIONS
layout(std140, binding = kRasterRegionsBlock) uniform Regions { RasterRegion regions[kMostRasterRegions]; };
RasterRegion region = RasterRegion(ivec2(0), ivec2(0), 0, 0, 0, 0);  // of the triangle in hand
#endif

// A buffer, not an image: its atomics without a result cost no waiting.
#ifdef KEEP
#elif defined(PACKED)
layout(std430, binding = kRasterDepthsBuffer) buffer Depths { uint64_t nearest[]; };  // depth, complement of the index
#elif defined(IDS)
layout(std430, binding = kRasterDepthsBuffer) readonly buffer Depths { uint depths[]; };
layout(std430, binding = kRasterIdsBuffer) buffer Ids { uint ids[]; };
#else
layout(std430, binding = kRasterDepthsBuffer) buffer Depths { uint depths[]; };
#endif
layout(std430, binding = kRasterQueueBuffer) buffer Queue {
  RasterQueueHeader queue;
  uvec2 bands[];  // triangle, first row of the band in its bounding box (above 16 bits: its region)
};

#ifdef PEEL
layout(binding = kRasterPreviousDepthUnit) uniform sampler2D previousDepth;
uniform float peelBias;
#endif

#ifdef SAMPLES
layout(binding = kSampleRasterCentreIdsUnit) uniform usampler2D centreIds;
layout(binding = kSampleRasterReachUnit) uniform sampler2D reach;
layout(binding = kSampleRasterMarksImage, r32ui) uniform coherent uimage2D marks;  // 1: the pixel is listed
#if defined(KEEP)
layout(binding = kSampleRasterTilesUnit) uniform usampler2D markedTiles;  // above 0: there are marks
layout(std430, binding = kSampleRasterKeptBuffer) buffer Kept {
  SampleListHeader kept;
  uint keptTriangles[];
};
#elif defined(KEPT)
layout(std430, binding = kSampleRasterKeptTrianglesBuffer) readonly buffer Kept {
  SampleListHeader kept;
  uint keptTriangles[];
};
#endif
#if !defined(IDS) && !defined(MARKED)
layout(std430, binding = kSampleRasterListBuffer) buffer List {
  SampleListHeader list;
  uint listed[];  // pixels, by row
};
#endif
uniform vec2 samplePlaces[SAMPLES];
const float kBeyondCentre = 0.5;  // pixels that samples lie from the centre at most, along each axis
#else
const float kBeyondCentre = 0.0;
#endif

#ifdef LISTED
layout(std430, binding = kRasterCountBuffer) readonly buffer Count { RasterCount listed_; };
uint smallLanes = SMALL_LANES;
int smallPixels = SMALL_PIXELS;
#else
const uint smallLanes = SMALL_LANES;
const int smallPixels = SMALL_PIXELS;
#endif
uniform uint triangleCount;  // of all ranges
uniform int rangeCount;      // 0: the triangles from 0 on

// As TriangleRanges has them: first triangle of a range, and the triangles up to its end.
#ifdef REGIONS
layout(std430, binding = kRasterRangesBuffer) readonly buffer Ranges { uvec4 ranges[]; };  // z: region
#else
#ifndef KEPT
layout(std430, binding = kRasterRangesBuffer) readonly buffer Ranges { uvec2 ranges[]; };
#endif
#endif

// Pixels that a triangle may write, the last included, and where a pixel's result is.
#ifdef REGIONS
const int kWordsOfPixel = REGIONS;  // 1: its depth; 2: its depth, and the complement of its triangle
ivec2 lowestPixel() { return region.low; }
ivec2 highestPixel() { return region.high - 1; }
int placeOf(ivec2 pixel) {
  const ivec2 at = pixel - region.low;
  return region.at + kWordsOfPixel * (at.y * (region.high.x - region.low.x) + at.x);
}
#else
ivec2 lowestPixel() { return ivec2(0); }
ivec2 highestPixel() { return sizePx - 1; }
int placeOf(ivec2 pixel) { return pixel.y * sizePx.x + pixel.x; }
#endif

// Pixels of a bounding box in a band, and rows that it has at least. Many groups share those of which each waits for what is
// known of it.
#if defined(SAMPLES) || defined(IDS)
const int kBandPixels = 1024, kFewestBandRows = 1;
#elif defined(REGIONS)
const int kBandPixels = 16384, kFewestBandRows = 4;
#else
const int kBandPixels = 2048, kFewestBandRows = 1;
#endif
const int kMostBandRows = 32, kMostBands = 2048;  // of a triangle: the queue has room for few hundreds of so many
const int kPlain = 1024;  // pixels of a band that a group goes through without cutting rows first, which costs it barriers

struct Triangle {
  vec3 a, b, c;   // clip space x, y, w
  ivec2 low, size;  // bounding box in pixels
  vec3 slack;     // of the products of edges; see productSlack
};

// Bounds how far the products u, v, w of covers() vary within kBeyondCentre of a pixel's centre along both axes, and their
// rounding.
vec3 productSlack(Triangle t) {
  const vec3 width = abs(vec3(t.a.x, t.b.x, t.c.x)) + abs(vec3(t.a.z, t.b.z, t.c.z));
  const vec3 height = abs(vec3(t.a.y, t.b.y, t.c.y)) + abs(vec3(t.a.z, t.b.z, t.c.z));
  vec3 slack = 1e-6 * (width.yzx * height.zxy + height.yzx * width.zxy);
#ifdef SAMPLES
  const vec3 across = vec3(t.b.z * t.c.y - t.b.y * t.c.z, t.c.z * t.a.y - t.c.y * t.a.z, t.a.z * t.b.y - t.a.y * t.b.z);
  const vec3 upwards = vec3(t.b.z * t.c.x - t.b.x * t.c.z, t.c.z * t.a.x - t.c.x * t.a.z, t.a.z * t.b.x - t.a.x * t.b.z);
  slack += 2.0 * kBeyondCentre * (abs(across) / float(sizePx.x) + abs(upwards) / float(sizePx.y));
#endif
  return slack;
}

// Pixel coordinates of a clip position, centre of pixel (0, 0) at 0. Row 0 is the top of clip space.
vec2 pixelOf(vec3 v) { return (vec2(v.x, -v.y) / v.z * 0.5 + 0.5) * vec2(sizePx) - 0.5; }

// Extends pixel bounds by what an edge shows in front of the near plane: its start, and where it passes the plane.
void extendBounds(vec3 from, vec3 to, inout vec2 low, inout vec2 high) {
  if (from.z >= near) {
    const vec2 at = pixelOf(from);
    low = min(low, at);
    high = max(high, at);
  }
  if ((from.z >= near) != (to.z >= near)) {
    vec3 crossing = mix(from, to, (near - from.z) / (to.z - from.z));
    crossing.z = near;
    // At the near plane a pixel is a tiny length; a share of the picture covers the rounding of the crossing.
    const vec2 at = pixelOf(crossing), slack = 1e-3 * (abs(at) + vec2(sizePx));
    low = min(low, at - slack);
    high = max(high, at + slack);
  }
}

Triangle load(uint index) {
  const uvec3 vertices = sceneTriangle(index);
  Triangle t;
  t.a = clipPosition(vertices.x);
  t.b = clipPosition(vertices.y);
  t.c = clipPosition(vertices.z);
  t.low = ivec2(0);
  t.size = ivec2(0);
  t.slack = productSlack(t);
  if (max(t.a.z, max(t.b.z, t.c.z)) < near) return t;
  vec2 low = vec2(1e30), high = vec2(-1e30);
  extendBounds(t.a, t.b, low, high);
  extendBounds(t.b, t.c, low, high);
  extendBounds(t.c, t.a, low, high);
  // Slack for the rounding of the quotients, far off the screen included.
  const vec2 limit = vec2(sizePx) + 1.0;
  low = clamp(low - (0.01 + kBeyondCentre), vec2(-1.0), limit);
  high = clamp(high + (0.01 + kBeyondCentre), vec2(-1.0), limit);
  t.low = max(ivec2(ceil(low)), lowestPixel());
  t.size = max(min(ivec2(floor(high)), highestPixel()) - t.low + 1, ivec2(0));
  if (t.size.x == 0 || t.size.y == 0) t.size = ivec2(0);
  return t;
}

#ifdef SAMPLES
// Whether the triangle may cover anything within kBeyondCentre of the pixel's centre.
bool isNear(Triangle t, ivec2 pixel) {
  const vec2 ndc = vec2(2.0, -2.0) * (vec2(pixel) + 0.5) / vec2(sizePx) + vec2(-1.0, 1.0);
  const vec2 a = t.a.xy - ndc * t.a.z, b = t.b.xy - ndc * t.b.z, c = t.c.xy - ndc * t.c.z;
  const vec3 products = vec3(product(b, c), product(c, a), product(a, b));
  return all(greaterThanEqual(products, -t.slack)) || all(lessThanEqual(products, t.slack));
}

#ifndef KEEP
void shade(Triangle t, uint index, ivec2 pixel) {
#ifdef MARKED
  if (imageLoad(marks, pixel).x == 0u) return;
#endif
  if (!isNear(t, pixel)) return;
#if defined(IDS) && !defined(MARKED)
  if (imageLoad(marks, pixel).x == 0u) return;
#endif
  // The centre's triangle, where it covers the whole pixel, joins when all is done.
  const float farthest = texelFetch(reach, pixel, 0).x;
  if (farthest > 0.0 && texelFetch(centreIds, pixel, 0).x == index) return;
  const int first = (pixel.y * sizePx.x + pixel.x) * SAMPLES;
#ifdef IDS
  uint nearest[SAMPLES];  // read together, to wait once
  for (int i = 0; i < SAMPLES; ++i) nearest[i] = depths[first + i];
#endif
  bool seen = false;
  for (int i = 0; i < SAMPLES; ++i) {
    float depth;
    if (!covers(t.a, t.b, t.c, vec2(pixel) + samplePlaces[i], depth) || depth < farthest) continue;
    const uint bits = floatBitsToUint(depth);
#ifdef IDS
    if (nearest[i] == bits) atomicMin(ids[first + i], index);
#else
    atomicMax(depths[first + i], bits);
    seen = true;
#endif
  }
#if !defined(IDS) && !defined(MARKED)
  if (seen && imageLoad(marks, pixel).x == 0u && imageAtomicExchange(marks, pixel, 1u) == 0u)
    listed[atomicAdd(list.pixels, 1u)] = uint(pixel.y * sizePx.x + pixel.x);
#endif
}
#endif
#else
void shade(Triangle t, uint index, ivec2 pixel) {
  float depth;
  if (!covers(t.a, t.b, t.c, vec2(pixel) + 0.5, depth)) return;
#ifdef PEEL
  // Reversed depth: what lies behind is smaller.
  if (!(depth * (1.0 + peelBias) < texelFetch(previousDepth, pixel, 0).x)) return;
#endif
  const uint bits = floatBitsToUint(depth);  // positive floats are ordered as their bits
  const int at = placeOf(pixel);
#if defined(PACKED)
#ifdef SHARES
  atomicMax(nearest[at], packUint2x32(uvec2(~(index | kSharedRasterTag), bits)));
#else
  atomicMax(nearest[at], packUint2x32(uvec2(~index, bits)));
#endif
#elif defined(IDS) && defined(REGIONS)
  if (depths[at] == bits) atomicMax(ids[at + 1], ~index);
#elif defined(IDS)
  if (depths[at] == bits) atomicMin(ids[at], index);
#else
  atomicMax(depths[at], bits);
#endif
}
#endif

int rowsOfBand(Triangle t) {
  const int leastRows = (t.size.y + kMostBands - 1) / kMostBands;
  return clamp(kBandPixels / t.size.x, max(kFewestBandRows, leastRows), kMostBandRows);
}

// Half-line of pixel positions in a row on which an edge's product u = first - x * second is not below `-slack`.
void cutSpan(float first, float second, float slack, inout float low, inout float high) {
  if (second > 0.0)
    high = min(high, (first + slack) / second);
  else if (second < 0.0)
    low = max(low, (first + slack) / second);
  else if (first + slack < 0.0)
    high = low - 1.0;
}

// Pixels of a row, from its bounding box's left side, among which are all that the triangle covers: [low, high]. A thin
// triangle covers little of its box. The products of shade() are linear along a row; `slack` bounds their rounding.
ivec2 rowSpan(Triangle t, int row) {
  const float y = -2.0 * (float(row) + 0.5) / float(sizePx.y) + 1.0;
  const float ay = t.a.y - y * t.a.z, by = t.b.y - y * t.b.z, cy = t.c.y - y * t.c.z;
  const vec3 first = vec3(t.b.x * cy - by * t.c.x, t.c.x * ay - cy * t.a.x, t.a.x * by - ay * t.b.x);
  const vec3 second = vec3(t.b.z * cy - by * t.c.z, t.c.z * ay - cy * t.a.z, t.a.z * by - ay * t.b.z);
  const vec3 slack = t.slack;
  const vec2 limit = vec2(-1.0, 1.0) * (1.0 + 2.0 * kBeyondCentre / float(sizePx.x));
  vec2 positive = limit, negative = limit;
  for (int i = 0; i < 3; ++i) {
    cutSpan(first[i], second[i], slack[i], positive.x, positive.y);
    cutSpan(-first[i], -second[i], slack[i], negative.x, negative.y);
  }
  // Either may be empty: low above high. A NaN stands for "anywhere" only if the box says so.
  vec2 span = vec2(1.0, -1.0);
  if (!(positive.x > positive.y)) span = positive;
  if (!(negative.x > negative.y)) span = span.x > span.y ? negative : vec2(min(span.x, negative.x), max(span.y, negative.y));
  if (span.x > span.y) return ivec2(0, -1);
  const vec2 at = (span * 0.5 + 0.5) * float(sizePx.x) - 0.5;
  const ivec2 pixels = ivec2(floor(at.x) - 1.0, ceil(at.y) + 1.0) - t.low.x;
  return clamp(pixels, ivec2(0, -1), ivec2(t.size.x, t.size.x - 1));
}

#ifndef KEEP
// Rows [first, end) of the bounding box by one invocation.
void shadeRows(Triangle t, uint index, int first, int end) {
  for (int y = first; y < end; ++y) {
    const ivec2 span = rowSpan(t, t.low.y + y);
    for (int x = span.x; x <= span.y; ++x) shade(t, index, t.low + ivec2(x, y));
  }
}
#endif

#ifdef LARGE
shared int spanStarts[kMostBandRows], pixelsUpTo[kMostBandRows];

// Rows of a band by a group: their spans one after another, so that lanes take neighbouring pixels.
void shadeBand(Triangle t, uint index, int first, int end) {
  const int lane = int(gl_LocalInvocationID.x), rows = end - first;
  barrier();  // the band before has been shaded
  if (lane < kMostBandRows) {
    const ivec2 span = lane < rows ? rowSpan(t, t.low.y + first + lane) : ivec2(0, -1);
    spanStarts[lane] = span.x;
    pixelsUpTo[lane] = max(span.y - span.x + 1, 0);
  }
  barrier();
  for (int step = 1; step < kMostBandRows; step *= 2) {
    const int before = lane >= step && lane < kMostBandRows ? pixelsUpTo[lane - step] : 0;
    barrier();
    if (lane < kMostBandRows) pixelsUpTo[lane] += before;
    barrier();
  }
  const int pixels = pixelsUpTo[kMostBandRows - 1];
  int row = 0;
  for (int i = lane; i < pixels; i += kRasterGroup) {
    while (pixelsUpTo[row] <= i) ++row;
    const int inRow = i - (row > 0 ? pixelsUpTo[row - 1] : 0);
    shade(t, index, t.low + ivec2(spanStarts[row] + inRow, first + row));
  }
}

// The same where a band is so small that pixels next to the triangle cost less than finding its spans.
void shadeBox(Triangle t, uint index, int first, int end) {
  const int pixels = (end - first) * t.size.x, stepX = kRasterGroup % t.size.x, stepY = kRasterGroup / t.size.x;
  const int lane = int(gl_LocalInvocationID.x);
  ivec2 at = ivec2(lane % t.size.x, first + lane / t.size.x);
  for (int i = lane; i < pixels; i += kRasterGroup) {
    shade(t, index, t.low + at);
    at += ivec2(stepX, stepY);
    if (at.x >= t.size.x) at += ivec2(-t.size.x, 1);
  }
}

void main() {
  const uint count = min(queue.queued, QUEUE_CAPACITY);
  for (uint item = gl_WorkGroupID.x; item < count; item += gl_NumWorkGroups.x) {
    const uint index = bands[item].x;
#ifdef REGIONS
    region = regions[bands[item].y >> 16];
    const int first = int(bands[item].y & 0xffffu);
#else
    const int first = int(bands[item].y);
#endif
    const Triangle t = load(index);
    const int end = min(first + rowsOfBand(t), t.size.y);
    if ((end - first) * t.size.x <= kPlain)
      shadeBox(t, index, first, end);
    else
      shadeBand(t, index, first, end);
  }
}
#else
#ifdef REGIONS
uint regionIndex = 0u;
#endif

#ifdef KEPT
uint chosenTriangle(uint n) { return keptTriangles[n]; }
uint chosenCount() { return kept.pixels; }
#else
#ifdef LISTED
uint chosenCount() { return listed_.triangles; }
#else
uint chosenCount() { return triangleCount; }
#endif
// Number in the scene of the n-th triangle drawn. Finds its region.
uint chosenTriangle(uint n) {
  if (rangeCount == 0) return n;
  int low = 0, high = rangeCount - 1;  // the first range that ends after n
  while (low < high) {
    const int middle = (low + high) / 2;
    if (ranges[middle].y > n)
      high = middle;
    else
      low = middle + 1;
  }
#ifdef REGIONS
  regionIndex = ranges[low].z;
  region = regions[regionIndex];
#endif
  return ranges[low].x + n - (low > 0 ? ranges[low - 1].y : 0u);
}
#endif

#ifdef KEEP
shared uint groupKept, firstKept;

bool reachesMark(Triangle t) {
  const ivec2 low = t.low / kGroupSide, high = (t.low + t.size - 1) / kGroupSide;
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      if (texelFetch(markedTiles, ivec2(x, y), 0).x > 0u) return true;
  return false;
}

// Whether the triangle is to be kept: it is small, and reaches a mark, or the queue has no room.
bool keeps(uint index) {
  const Triangle t = load(index);
  const int pixels = t.size.x * t.size.y;
  if (pixels <= smallPixels) return pixels > 0 && reachesMark(t);
  const int rows = rowsOfBand(t), count = (t.size.y + rows - 1) / rows;
  const uint slot = atomicAdd(queue.queued, uint(count));
  for (int band = 0; band < count && slot + uint(band) < QUEUE_CAPACITY; ++band)
    bands[slot + uint(band)] = uvec2(index, uint(band * rows));
  return slot + uint(count) > QUEUE_CAPACITY;
}

void main() {
  if (gl_LocalInvocationID.x == 0u) groupKept = 0u;
  barrier();
  const uint drawn = gl_GlobalInvocationID.y * kRasterRowInvocations + gl_GlobalInvocationID.x;
  uint index = 0u;
  bool isKept = false;
  if (gl_GlobalInvocationID.x < kRasterRowInvocations && drawn < triangleCount) {
    index = chosenTriangle(drawn);
    isKept = keeps(index);
  }
  const uint slot = isKept ? atomicAdd(groupKept, 1u) : 0u;
  barrier();
  if (gl_LocalInvocationID.x == 0u && groupKept > 0u) firstKept = atomicAdd(kept.pixels, groupKept);
  barrier();
  if (isKept) keptTriangles[firstKept + slot] = index;
}
#else
void shadeOrQueue(uint drawn, uint lane) {
  const uint index = chosenTriangle(drawn);
  const Triangle t = load(index);
  const int pixels = t.size.x * t.size.y;
#ifdef KEPT
  const bool isLarge = false;
#else
  const bool isLarge = pixels > smallPixels;
#endif
  if (!isLarge) {
    if (pixels == 0) return;
    const ivec2 step = ivec2(int(smallLanes) % t.size.x, int(smallLanes) / t.size.x);
    ivec2 at = ivec2(int(lane) % t.size.x, int(lane) / t.size.x);
    while (at.y < t.size.y) {
      shade(t, index, t.low + at);
      at += step;
      if (at.x >= t.size.x) at += ivec2(-t.size.x, 1);
    }
    return;
  }
  if (lane > 0u) return;
  const int rows = rowsOfBand(t);
  const uint slot = atomicAdd(queue.queued, uint((t.size.y + rows - 1) / rows));
  for (int first = 0, band = 0; first < t.size.y; first += rows, ++band) {
    if (slot + uint(band) < QUEUE_CAPACITY)
#ifdef REGIONS
      bands[slot + uint(band)] = uvec2(index, uint(first) | regionIndex << 16);
#else
      bands[slot + uint(band)] = uvec2(index, uint(first));
#endif
    else
      shadeRows(t, index, first, min(first + rows, t.size.y));
  }
}

void main() {
#ifdef LISTED
  const uint count = chosenCount();
  if (count <= uint(2 * sizePx.x * sizePx.y) / uint(FEW_LANES)) {
    smallLanes = FEW_LANES;
    smallPixels = FEW_PIXELS;
  }
  const uint perStep = gl_NumWorkGroups.x * uint(kRasterGroup) / smallLanes;
  for (uint drawn = gl_GlobalInvocationID.x / smallLanes; drawn < count; drawn += perStep)
    shadeOrQueue(drawn, gl_GlobalInvocationID.x % smallLanes);
#else
  if (gl_GlobalInvocationID.x >= kRasterRowInvocations) return;
  const uint invocation = gl_GlobalInvocationID.y * kRasterRowInvocations + gl_GlobalInvocationID.x;
  const uint drawn = invocation / smallLanes;
  if (drawn < chosenCount()) shadeOrQueue(drawn, invocation % smallLanes);
#endif
}
#endif
#endif
