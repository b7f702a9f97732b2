// SPDX-License-Identifier: BSD-3-Clause
// A list of leaves for each view, at random but the same in every frame. See fixed_points.h.
#include "renderer/many_lods/many_lods_bindings.h"

layout(local_size_x = kSplatGroup) in;
layout(std430, binding = kCutListBuffer) writeonly buffer List { uvec2 list[]; };

uniform uint leaves, perView, count, seed;

uint hashed(uint value) {
  value = (value ^ value >> 16u) * 0x7feb352du;
  value = (value ^ value >> 15u) * 0x846ca68bu;
  return value ^ value >> 16u;
}

void main() {
  for (uint i = gl_GlobalInvocationID.x; i < count; i += gl_NumWorkGroups.x * uint(kSplatGroup)) {
    const uint view = i / perView, point = i % perView;
    // One of each run of leaves, so that they are even over the surface.
    const uint low = uint(float(point) / float(perView) * float(leaves));
    const uint high = max(uint(float(point + 1u) / float(perView) * float(leaves)), low + 1u);
    const uint leaf = min(low + hashed(hashed(view * 0x9e3779b9u + seed) + point) % (high - low), leaves - 1u);
    list[i] = uvec2(leaves + leaf, view | kEntryDone);
  }
}
