// SPDX-License-Identifier: BSD-3-Clause
// Means of the values of the leaves for all nodes above, several levels a dispatch. See value_tree.h.
#include "renderer/many_lods/many_lods_bindings.h"

layout(local_size_x = kUpdateGroup) in;
layout(std430, binding = kAverageValuesBuffer) buffer Values { uvec2 values[]; };

uniform uint first;  // node: of the level whose nodes are averaged; as many as its number

shared vec4 line[kUpdateGroup];

vec4 valueOf(uint node) {
  const uvec2 halves = values[node];
  return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));
}

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint at = gl_WorkGroupID.x * 2u * uint(kUpdateGroup) + 2u * me;
  vec4 own = vec4(0.0);
  if (at < first) own = 0.5 * (valueOf(first + at) + valueOf(first + at + 1u));
  uint level = first >> 1u, width = uint(kUpdateGroup);
  while (true) {
    const uint here = gl_WorkGroupID.x * width + me;
    if (me < width && here < level) values[level + here] = uvec2(packHalf2x16(own.xy), packHalf2x16(own.zw));
    if (level <= 1u || width == 1u) break;
    barrier();
    line[me] = own;
    barrier();
    level >>= 1u;
    width >>= 1u;
    if (me < width) own = 0.5 * (line[2u * me] + line[2u * me + 1u]);
  }
}
