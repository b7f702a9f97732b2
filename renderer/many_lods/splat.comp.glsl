// SPDX-License-Identifier: BSD-3-Clause
// Draws the nodes of a list of cuts into their views' tiles as discs, the projections of their spheres. FORM: what is kept of the
// nearest (view_atlas.h). WINNERS: second pass of kFormTwoPasses. ORIENTED: splat_disc.glsl. OWNERS: nodes of a view's own
// object are left out.
#if FORM == 2
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_NV_shader_atomic_int64 : require
#endif
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/many_lods/depth_packing.glsl"

layout(local_size_x = kSplatGroup) in;
layout(std430, binding = kCutNodesBuffer) readonly buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kCutListBuffer) readonly buffer List { uvec2 list[]; };
layout(std430, binding = kCutControlBuffer) readonly buffer Control { CutControl control; };
#if FORM == 2
layout(std430, binding = kSplatDepthsBuffer) buffer Depths { uint64_t depths[]; };
#else
layout(std430, binding = kSplatDepthsBuffer) buffer Depths { uint depths[]; };
#endif
#if FORM == 1 || FORM == 3
layout(std430, binding = kSplatWinnersBuffer) buffer Winners { uint winners[]; };
#endif
#if FORM == 3
layout(std430, binding = kSplatColoursBuffer) readonly buffer Colours { uvec2 colours[]; };
#endif

#ifdef OWNERS
layout(std430, binding = kSplatOwnersBuffer) readonly buffer Owners { uint owners[]; };  // of nodes; 0: none, or several
#endif

#include "renderer/many_lods/splat_disc.glsl"

bool isOwn(uvec2 entry) {
#ifdef OWNERS
  const uint owner = uint(views[entry.y & ~kEntryDone].frustum.w);
  return owner != 0u && owners[entry.x] == owner;
#else
  return false;
#endif
}

void cover(Disc disc, ivec2 pixel) {
  uint depth;
  if (!coversPixel(disc, pixel, depth)) return;
  const uint at = (disc.view * uint(tilePx.y) + uint(pixel.y)) * uint(tilePx.x) + uint(pixel.x);
#if FORM == 0
  atomicMin(depths[at], depth);
#elif FORM == 1
#ifdef WINNERS
  if (depths[at] == depth) atomicMin(winners[at], disc.node);
#else
  atomicMin(depths[at], depth);
#endif
#elif FORM == 2
  atomicMin(depths[at], packUint2x32(uvec2(disc.node, depth)));
#else
  const uvec2 halves = colours[disc.node];
  const vec3 colour = clamp(vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x), 0.0, 1.0);
  const uvec3 bytes = uvec3(round(colour * 255.0));
  const uvec2 words = packedSplat(uintBitsToFloat(depth), bytes.x | bytes.y << 8u | bytes.z << 16u);
  atomicMin(depths[at], words.x);
  atomicMin(winners[at], words.y);
#endif
}

// Larger discs are drawn by the whole group, a row at a time.
shared Disc large[kSplatGroup];
shared uint firstRow[kSplatGroup];
shared uint largeRows;  // in the low kRowBits bits; above them how many discs they are of
const uint kRowBits = 23u;

// The last disc that starts at this row or before it.
uint discOfRow(uint row, uint discs) {
  uint low = 0u, high = discs;
  while (high - low > 1u) {
    const uint middle = (low + high) / 2u;
    if (firstRow[middle] <= row) low = middle;
    else high = middle;
  }
  return low;
}

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint count = control.count, at = control.readAt;
  for (uint first = gl_WorkGroupID.x * uint(kSplatGroup); first < count; first += gl_NumWorkGroups.x * uint(kSplatGroup)) {
    if (me == 0u) largeRows = 0u;
    barrier();
    Disc disc;
    if (first + me < count && !isOwn(list[at + first + me]) && discOf(list[at + first + me], disc)) {
      ivec2 low, high;
      boxOf(disc, low, high);
      const ivec2 size = max(high - low + 1, ivec2(0));
      if (size.x * size.y > kSmallSplatPx) {
        const uint before = atomicAdd(largeRows, 1u << kRowBits | uint(size.y));
        large[before >> kRowBits] = disc;
        firstRow[before >> kRowBits] = before & ((1u << kRowBits) - 1u);
      } else {
        for (int y = low.y; y <= high.y; ++y)
          for (int x = low.x; x <= high.x; ++x) cover(disc, ivec2(x, y));
      }
    }
    barrier();
    const uint discs = largeRows >> kRowBits, rows = largeRows & ((1u << kRowBits) - 1u);
    for (uint row = me; row < rows; row += uint(kSplatGroup)) {
      const uint i = discOfRow(row, discs);
      const Disc shared_ = large[i];
      ivec2 low, high;
      boxOf(shared_, low, high);
      const int y = low.y + int(row - firstRow[i]);
      for (int x = low.x; x <= high.x; ++x) cover(shared_, ivec2(x, y));
    }
    barrier();
  }
}
