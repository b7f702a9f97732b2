// SPDX-License-Identifier: BSD-3-Clause
// The pairs that remain: each ray of the node with the triangle. Neighbours share the triangle.
uniform ivec2 sizePx;
#include "renderer/techniques/reflections/ray_hierarchy/nearest.glsl"

layout(local_size_x = kTraversalGroup) in;
layout(std430, binding = kHierarchyPairsBuffer) readonly buffer Pairs { uvec2 pairs[]; };
layout(std430, binding = kHierarchyControlBuffer) buffer Control { HierarchyControl control; };
uniform uint leafLevel;

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
