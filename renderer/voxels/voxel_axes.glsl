// SPDX-License-Identifier: BSD-3-Clause
// Axes of a grid: the one that a triangle is assigned to, and what lies across one.
#include "renderer/voxels/voxel_bindings.h"

// Of components that are equal but for rounding the first, so that neither the place nor the size of a world decides.
int longestAxis(vec3 v) {
  const vec3 size = abs(v), least = (1.0 - kEqualAxes) * size;
  return size.x >= least.y && size.x >= least.z ? 0 : size.y >= least.z ? 1 : 2;
}

ivec2 acrossAxis(int axis) { return ivec2((axis + 1) % 3, (axis + 2) % 3); }

vec2 across(vec3 v, int axis) { return axis == 0 ? v.yz : axis == 1 ? v.zx : v.xy; }
ivec2 across(ivec3 v, int axis) { return axis == 0 ? v.yz : axis == 1 ? v.zx : v.xy; }
