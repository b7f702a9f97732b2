// SPDX-License-Identifier: BSD-3-Clause
// One group: where the entries of each tile go, how many splits there is room for, and the arguments of what follows.
#include "renderer/many_lods/cut_lists.glsl"

layout(local_size_x = kCutScanGroup) in;
layout(std430, binding = kCutTilesBuffer) buffer Tiles { uvec2 tiles[]; };

uniform uint lastStep;  // steps end here even if entries are unfinished
uniform uint always;    // not 0: they do not end sooner

shared uvec2 line[kCutScanGroup];

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint count = steps[step_].count;
  const uint tileCount = (count + uint(kCutTile) - 1u) / uint(kCutTile);
  uvec2 before = uvec2(0u);
  for (uint first = 0u; first < tileCount; first += uint(kCutScanGroup * kCutScanRows)) {
    uvec2 own[kCutScanRows];
    uvec2 sum = uvec2(0u);
    const uint at = first + me * uint(kCutScanRows);
    for (int row = 0; row < kCutScanRows; ++row) {
      own[row] = at + uint(row) < tileCount ? tiles[at + uint(row)] : uvec2(0u);
      sum += own[row];
    }
    barrier();
    line[me] = sum;
    barrier();
    for (uint step2 = 1u; step2 < uint(kCutScanGroup); step2 *= 2u) {
      uvec2 upTo = line[me];
      if (me >= step2) upTo += line[me - step2];
      barrier();
      line[me] = upTo;
      barrier();
    }
    uvec2 here = before + line[me] - sum;
    for (int row = 0; row < kCutScanRows; ++row) {
      if (at + uint(row) < tileCount) tiles[at + uint(row)] = here;
      here += own[row];
    }
    before += line[kCutScanGroup - 1];
  }
  if (me > 0u) return;
  // Entries never become more than there were, plus one for each split.
  const uint budget = capacity - before.x;
  const uint splits = min(before.y, budget);
  const uint next = before.x + splits;
  const uint writeAt = capacity - steps[step_].readAt;
  steps[step_].budget = budget;
  steps[step_].emitX = groupsFor(count, uint(kCutTile));
  steps[step_].emitY = steps[step_].emitZ = 1u;
  control.refused += before.y - splits;
  control.splits += splits;
  control.steps = step_ + 1u;
  control.count = next;
  control.readAt = writeAt;
  control.drawX = groupsFor(next, uint(kSplatGroup));
  control.drawY = control.drawZ = 1u;
  if (step_ < lastStep && (always != 0u || steps[step_].unfinished != 0u)) {
    CutStep following = CutStep(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    following.classifyX = groupsFor(next, uint(kCutTile));
    following.classifyY = following.classifyZ = 1u;
    following.scanX = following.scanY = following.scanZ = 1u;
    following.readAt = writeAt;
    following.count = next;
    steps[step_ + 1u] = following;
  }
}
