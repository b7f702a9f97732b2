// SPDX-License-Identifier: BSD-3-Clause
// Starts a frame. RESTART: with the root in every view.
#include "renderer/many_lods/cut_lists.glsl"

layout(local_size_x = kCutGroup) in;

uniform uint viewCount;
uniform uint tile;     // entries of a group
uniform uint regions;  // of the list: 2, or 3 where entries that are left over lie apart

void main() {
#ifdef RESTART
  for (uint i = gl_GlobalInvocationID.x; i < viewCount; i += gl_NumWorkGroups.x * uint(kCutGroup)) {
    list[i] = uvec2(kRootNode, i);
#ifdef MARGINS
    margins[i] = 0u;
#endif
  }
#endif
  if (gl_WorkGroupID.x > 0u) return;
  const CutStep none = CutStep(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
  for (uint i = gl_LocalInvocationIndex + 1u; i < uint(kMostCutSteps); i += uint(kCutGroup)) steps[i] = none;
  if (gl_LocalInvocationIndex > 0u) return;
#ifdef RESTART
  control.count = viewCount;
  control.readAt = 0u;
#endif
  control.refused = 0u;
  control.splits = 0u;
  control.steps = 0u;
  control.tests = 0u;
  control.merges = 0u;
  CutStep first = none;
  first.classifyX = groupsFor(control.count, tile);
  first.classifyY = first.classifyZ = 1u;
  first.scanX = first.scanY = first.scanZ = 1u;
  first.readAt = control.readAt;
  first.count = control.count;
  const uint region = control.readAt / capacity;
  first.finishedAt = (region + 1u) % regions * capacity;
  first.leftAt = (region + 2u) % regions * capacity;
  steps[0] = first;
}
