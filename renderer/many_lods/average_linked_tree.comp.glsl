// SPDX-License-Identifier: BSD-3-Clause
// Means of the values of the leaves for the nodes of one level of a tree that is not complete, from the level below. See value_tree.h.
#include "renderer/many_lods/many_lods_bindings.h"

layout(local_size_x = kUpdateGroup) in;
layout(std430, binding = kAverageValuesBuffer) buffer Values { uvec2 values[]; };
layout(std430, binding = kCutLinksBuffer) readonly buffer Links { TreeLink links[]; };

uniform uint first, end;  // nodes of the level

vec4 sumOf(uint node) {
  const uvec2 halves = values[node];
  return float(links[node].leaves) * vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));
}

void main() {
  const uint node = first + gl_GlobalInvocationID.x;
  if (node >= end) return;
  const uint child = links[node].firstChild;
  if (child == 0u) return;
  const vec4 mean = (sumOf(child) + sumOf(child + 1u)) / float(links[node].leaves);
  values[node] = uvec2(packHalf2x16(mean.xy), packHalf2x16(mean.zw));
}
