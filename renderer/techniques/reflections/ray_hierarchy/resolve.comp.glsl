// SPDX-License-Identifier: BSD-3-Clause
// The pairs that remain: each ray of the node with the triangle. Neighbours share the triangle. Of cones (CONES): the pairs
// themselves, with their ranks among those of their tile.
uniform ivec2 sizePx;
#include "renderer/frame/frame_bindings.h"
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"
#ifdef CONES
#include "renderer/techniques/reflections/ray_hierarchy/tiles.glsl"
#else
#include "renderer/techniques/reflections/ray_hierarchy/nearest.glsl"
#endif

layout(local_size_x = kTraversalGroup) in;
layout(std430, binding = kHierarchyPairsBuffer) readonly buffer Pairs { uvec2 pairs[]; };
layout(std430, binding = kHierarchyControlBuffer) buffer Control { HierarchyControl control; };
#ifndef TILES
uniform uint leafLevel;
#endif
#ifdef CONES
layout(std430, binding = kHierarchyGatheredBuffer) writeonly buffer Gathered { uint gathered[]; };
uniform uint gatheredRoom;
shared uint groupPairs, groupFirst;

void main() {
  const uint at = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kTraversalGroup) +
                  gl_LocalInvocationIndex;
  const uvec2 pair = at < control.inputs ? pairs[at] : uvec2(0u);
  const bool live = at < control.inputs && pair.x >> (2 * kNodeBits) == leafLevel;
  if (gl_LocalInvocationIndex == 0u) groupPairs = 0u;
  barrier();
  const uint slot = live ? atomicAdd(groupPairs, 1u) : 0u;
  barrier();
  if (gl_LocalInvocationIndex == 0u && groupPairs > 0u) groupFirst = atomicAdd(tiles[tileGathered()], groupPairs);
  barrier();
  if (!live) return;
  const uint side = (1u << kNodeBits) - 1u;
  const uint tile = tileOf(ivec2(pair.x & side, (pair.x >> kNodeBits) & side));
  const uint into = groupFirst + slot;
  if (into >= gatheredRoom) {
    tiles[tileLacks(tile)] = 1u;
    return;
  }
  gathered[3u * into] = tile;
  gathered[3u * into + 1u] = atomicAdd(tiles[tile], 1u);
  gathered[3u * into + 2u] = pair.y;
}
#else

void main() {
  const uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kTraversalGroup) +
                     gl_LocalInvocationIndex;
  const uint at = index >> (2u * leafLevel), mask = (1u << leafLevel) - 1u;
  if (at >= control.inputs) return;
  const uvec2 pair = pairs[at];
  if (pair.x >> (2 * kNodeBits) != leafLevel) return;  // only in batches of pairs that waited
  const uint side = (1u << kNodeBits) - 1u;
  const ivec2 pixel = (ivec2(pair.x & side, (pair.x >> kNodeBits) & side) << leafLevel) +
                      ivec2(index & mask, (index >> leafLevel) & mask);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  meet(pixel, pair.y);
}
#endif
