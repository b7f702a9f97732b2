// SPDX-License-Identifier: BSD-3-Clause
// Cuts and their drawing in one dispatch: each group walks down the tree for a few views with a stack in shared memory, and draws
// what is fine enough. See in_place_cuts.h. FINDERS: invocations that find cuts; FINISHED: nodes that each may have waiting to be
// drawn; STACK: entries of the stack; FLAG_SCAN (flag_scan.glsl); DISCARD: nothing is drawn.
#if FLAG_SCAN == 1
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#elif FLAG_SCAN == 2
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_ARB_shader_ballot : require
#endif
#define FLAG_GROUP kInPlaceGroup
#include "renderer/many_lods/node_predicate.glsl"

layout(local_size_x = kInPlaceGroup) in;
#include "renderer/many_lods/flag_scan.glsl"
layout(std430, binding = kCutNodesBuffer) readonly buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kSplatDepthsBuffer) buffer Depths { uint depths[]; };
layout(std430, binding = kInPlaceCountsBuffer) buffer Counts { InPlaceCounts counts; };
#include "renderer/many_lods/splat_disc.glsl"

uniform uint leaves, viewCount, viewsPerGroup;

shared uvec2 stack[STACK];
shared uvec2 finished[FINDERS * FINISHED];

void drawPixel(Disc disc, ivec2 pixel) {
  uint depth;
  if (!coversPixel(disc, pixel, depth)) return;
  atomicMin(depths[(disc.view * uint(tilePx.y) + uint(pixel.y)) * uint(tilePx.x) + uint(pixel.x)], depth);
}

// By the whole group: a node each, and the large ones together.
void drawFinished(uint count) {
#ifndef DISCARD
  for (uint i = gl_LocalInvocationIndex; i < count; i += uint(kInPlaceGroup)) {
    Disc disc;
    if (!discOf(finished[i], disc)) continue;
    ivec2 low, high;
    boxOf(disc, low, high);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) drawPixel(disc, ivec2(x, y));
  }
#endif
}

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint firstView = gl_WorkGroupID.x * viewsPerGroup;
  uint stacked = min(viewsPerGroup, viewCount - min(firstView, viewCount)), waiting = 0u, deepest = stacked, refused = 0u;
  uint drawn = 0u, rounds = 0u;
  for (uint i = me; i < stacked; i += uint(kInPlaceGroup)) stack[i] = uvec2(kRootNode, firstView + i);
  barrier();
  // All of the group hold the same counts, so that they meet at every barrier.
  while (stacked > 0u) {
    const uint popped = min(stacked, uint(FINDERS));
    stacked -= popped;
    ++rounds;
    uvec2 entry = uvec2(0u);
    bool split_ = false, draw = false;
    if (me < popped) {
      entry = stack[stacked + me];
      const CutView view = views[entry.y];
      const vec4 sphere = nodes[entry.x];
      const bool culled = isCulled(sphere.xyz, sphere.w, entry.x, leaves, view);
      draw = !culled && (entry.x >= leaves || isFineEnough(sphere, view));
      split_ = !culled && !draw;
    }
    uint splits, draws;
    const uint splitAt = flagsBefore(split_, splits);
    // What the stack has no room for is drawn as it is. (The bound on the stack says that there is none.)
    const uint room = (uint(STACK) - stacked) / 2u;
    if (split_ && splitAt >= room) split_ = false, draw = true;
    refused += splits - min(splits, room);
    splits = min(splits, room);
    const uint drawAt = flagsBefore(draw, draws);
    if (split_) {
      stack[stacked + 2u * splitAt] = uvec2(2u * entry.x + 1u, entry.y);
      stack[stacked + 2u * splitAt + 1u] = uvec2(2u * entry.x, entry.y);
    }
    if (draw) finished[waiting + drawAt] = entry;
    stacked += 2u * splits;
    waiting += draws;
    drawn += draws;
    deepest = max(deepest, stacked);
    barrier();
    if (waiting + uint(FINDERS) > uint(FINDERS * FINISHED) || stacked == 0u) {
      drawFinished(waiting);
      waiting = 0u;
      barrier();
    }
  }
  if (me == 0u) {
    atomicMax(counts.deepest, deepest);
    if (stacked > 0u || waiting > 0u) atomicAdd(counts.unfinished, 1u);
    if (refused > 0u) atomicAdd(counts.refused, refused);
    atomicAdd(counts.drawn, drawn);
    atomicAdd(counts.rounds, rounds);
  }
}
