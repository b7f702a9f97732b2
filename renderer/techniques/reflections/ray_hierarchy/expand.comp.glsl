// SPDX-License-Identifier: BSD-3-Clause
// One step down the hierarchy for all pairs of nodes and triangles (Roger 2008, section 3.3.3): a node's four children
// against the triangle's sphere, and those that remain packed by the group, which asks for room once.
//   START   reads no pairs: all triangles of a batch with all nodes of level `fromLevel`, above which nothing is tested
//   FINISH  takes the groups that found no room, and goes down to the rays on the spot; each layer of groups within one region
//           of the picture, so that a software renderer's loops end in time
//   SPILL   pairs without room go to a buffer of pairs that wait
//   CONES   those that find no room mark their tiles as lacking pairs, on the way to the rays
//   SPARSE  four places for each pair, valid or not, that a stream reduction packs; pairs from `capacity` on find no room
uniform ivec2 sizePx;
#include "renderer/compute/reduction_bindings.h"
#include "renderer/frame/frame_bindings.h"
#include "renderer/techniques/reflections/ray_hierarchy/nodes.glsl"
#if defined(FINISH) && defined(CONES)
#include "renderer/techniques/reflections/ray_hierarchy/tiles.glsl"
#elif defined(FINISH)
#include "renderer/techniques/reflections/ray_hierarchy/nearest.glsl"
#else
layout(std430, binding = kHierarchyOutBuffer) writeonly buffer Out { uvec2 outPairs[]; };
#endif
#ifdef SPILL
layout(std430, binding = kHierarchySpillBuffer) writeonly buffer Spill { uvec2 spillPairs[]; };
uniform uint spillCapacity;
#endif

layout(local_size_x = kTraversalGroup) in;
layout(std430, binding = kHierarchySpheresBuffer) readonly buffer Spheres { vec4 spheres[]; };
layout(std430, binding = kHierarchyPairsBuffer) readonly buffer Pairs { uvec2 pairs[]; };
layout(std430, binding = kHierarchyControlBuffer) buffer Control { HierarchyControl control; };
layout(std430, binding = kHierarchyLeftBuffer) buffer Left { uint leftGroups[]; };

uniform uint capacity;
#ifndef TILES
uniform uint leafLevel;
#endif
#ifdef START
uniform uint firstTriangle, triangleCount, fromLevel;
#endif

const uint kPlaceMask = (1u << kNodeBits) - 1u;
ivec2 placeOf(uint node) { return ivec2(node & kPlaceMask, (node >> kNodeBits) & kPlaceMask); }
uint levelOf(uint node) { return node >> (2 * kNodeBits); }
uint nodeOf(uint level, ivec2 at) { return level << (2 * kNodeBits) | uint(at.y) << kNodeBits | uint(at.x); }

#ifdef FINISH
uniform int mostIterations;
uniform uint regionLevel;  // of the nodes that are the regions
uniform int regionsAcross;

#ifdef CONES
void meetAll(ivec2 at, uint triangle) { tiles[tileLacks(tileOf(at))] = 1u; }
void cutShort() { tiles[tileCutShort()] = 1u; }
#else
void cutShort() { hits[sizePx.x * sizePx.y].distance = 1u; }

// Rays of a node of the last level.
void meetAll(ivec2 at, uint triangle) {
  for (int i = 0; i < 1 << (2u * leafLevel); ++i) {
    const ivec2 pixel = (at << leafLevel) + ivec2(i & ((1 << leafLevel) - 1), i >> leafLevel);
    if (all(lessThan(pixel, sizePx))) meet(pixel, triangle);
  }
}
#endif

int iterations = 0;  // loop rounds, but for those in which only neighbours take part

// All that lies below the node, which the sphere may meet: without a stack, as children follow from places.
void descend(uint top, ivec2 at, uint triangle, vec4 sphere) {
  uint level = top;
  bool meets = true;
  while (true) {
    if (++iterations > mostIterations) {
      control.cutShort = 1u;
      cutShort();
      return;
    }
    if (meets && level > leafLevel) {
      --level;
      at *= 2;
    } else {
      if (meets) {
        iterations += 3 << (2u * leafLevel);
        meetAll(at, triangle);
      }
      ++iterations;
      while (level < top && (at.x & at.y & 1) == 1) {
        ++iterations;
        at >>= 1;
        ++level;
      }
      if (level >= top) return;
      at = (at.x & 1) == 0 ? ivec2(at.x + 1, at.y) : ivec2(at.x - 1, at.y + 1);
    }
    meets = all(lessThan(at, levelSize(level))) && mayMeet(nodeAt(level, at), sphere);
  }
}

// What of the node lies in this group's region.
void descendRegion(uint level, ivec2 at, uint triangle, vec4 sphere) {
  const ivec2 region = ivec2(int(gl_WorkGroupID.z) % regionsAcross, int(gl_WorkGroupID.z) / regionsAcross);
  if (level <= regionLevel) {
    if (at >> int(regionLevel - level) == region) descend(level, at, triangle, sphere);
  } else if (region >> int(level - regionLevel) == at && mayMeet(nodeAt(regionLevel, region), sphere)) {
    descend(regionLevel, region, triangle, sphere);
  }
}
#else
const uint kIntoStream = 0u, kIntoSpill = 1u, kNowhere = 2u;
shared uint groupPairs, groupFirst, groupGoes;
#endif

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
#ifdef FINISH
  if (group >= control.finishGroups) return;
#ifdef SPARSE
  group += capacity / uint(kTraversalGroup);
#else
  group = leftGroups[group];
#endif
#endif
#ifdef START
  const uint perRow = (triangleCount + uint(kTraversalGroup) - 1u) / uint(kTraversalGroup);
  const ivec2 wide = levelSize(fromLevel + 1u);
  const uint row = group / perRow, at = (group - row * perRow) * uint(kTraversalGroup) + gl_LocalInvocationIndex;
  const ivec2 place = ivec2(int(row) % wide.x, int(row) / wide.x);
  const uint triangle = firstTriangle + at, childLevel = fromLevel;
  const bool live = at < triangleCount && place.y < wide.y;
#else
  const uint at = group * uint(kTraversalGroup) + gl_LocalInvocationIndex;
#ifdef FINISH
  const bool present = at < control.previousInputs;
#elif defined(SPARSE)
  const bool present = at < min(control.inputs, capacity);
#else
  const bool present = at < control.inputs;
#endif
  const uvec2 pair = present ? pairs[at] : uvec2(0u);
  // Pairs of the last level are resolved elsewhere.
  const bool live = present && levelOf(pair.x) > leafLevel;
  const ivec2 place = placeOf(pair.x);
  const uint triangle = pair.y, childLevel = levelOf(pair.x) - 1u;
#endif
  uint found = 0u;
  const vec4 sphere = live ? spheres[triangle] : vec4(0.0, 0.0, 0.0, -1.0);
  if (sphere.w >= 0.0) {
    const ivec2 size = levelSize(childLevel);
    for (int child = 0; child < 4; ++child) {
      const ivec2 there = 2 * place + ivec2(child & 1, child >> 1);
      if (all(lessThan(there, size)) && mayMeet(nodeAt(childLevel, there), sphere)) found |= 1u << child;
    }
  }
#ifdef FINISH
  for (int child = 0; child < 4; ++child)
    if ((found >> child & 1u) != 0u)
      descendRegion(childLevel, 2 * place + ivec2(child & 1, child >> 1), triangle, sphere);
#elif defined(SPARSE)
  const uint slot = 4u * (group * uint(kTraversalGroup) + gl_LocalInvocationIndex);
  for (int child = 0; child < 4; ++child)
    outPairs[slot + uint(child)] =
        (found >> child & 1u) != 0u
            ? uvec2(nodeOf(childLevel, 2 * place + ivec2(child & 1, child >> 1)), triangle)
            : uvec2(kInvalidItem, 0u);
#else
  if (gl_LocalInvocationIndex == 0u) groupPairs = 0u;
  barrier();
  const uint own = uint(bitCount(found));
  uint slot = own > 0u ? atomicAdd(groupPairs, own) : 0u;
  barrier();
  if (groupPairs == 0u) return;
  if (gl_LocalInvocationIndex == 0u) {
    const uint first = atomicAdd(control.outputs, groupPairs);
    groupFirst = first;
    groupGoes = kIntoStream;
    // All groups or none: from the first one without room on none has any, as the sum only grows. (It cannot wrap: batches
    // are too small for that.)
    if (first + groupPairs > capacity) {
      atomicMin(control.limit, first);
      groupGoes = kNowhere;
#ifdef SPILL
      groupFirst = atomicAdd(control.spilled, groupPairs);
      if (groupFirst + groupPairs <= spillCapacity)
        groupGoes = kIntoSpill;
      else
        atomicMin(control.spillLimit, groupFirst);
#endif
      if (groupGoes == kNowhere) leftGroups[atomicAdd(control.left, 1u)] = group;
    }
  }
  barrier();
  if (groupGoes == kNowhere) return;
  slot += groupFirst;
  for (int child = 0; child < 4; ++child) {
    if ((found >> child & 1u) == 0u) continue;
    const uvec2 kept = uvec2(nodeOf(childLevel, 2 * place + ivec2(child & 1, child >> 1)), triangle);
#ifdef SPILL
    if (groupGoes == kIntoSpill) {
      spillPairs[slot++] = kept;
      continue;
    }
#endif
    outPairs[slot++] = kept;
  }
#endif
}
