// SPDX-License-Identifier: BSD-3-Clause
// One group: where what becomes of each tile goes, how many splits there is room for, and the arguments of what follows. ORDERED: the
// step writes the whole list.
#include "renderer/many_lods/cut_lists.glsl"

layout(local_size_x = kCutScanGroup) in;
layout(std430, binding = kCutTilesBuffer) buffer Tiles { uvec4 tiles[]; };

uniform uint lastStep;    // steps end here even if entries are left over
uniform uint always;      // not 0: they do not end sooner
uniform uint splitsEach;  // of a node by one level of the tree; rooms are used up in these

shared uvec3 line[kCutScanGroup];

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint count = steps[step_].count;
  const uint tileCount = (count + uint(kCutTile) - 1u) / uint(kCutTile);
  uvec3 before = uvec3(0u);
  for (uint first = 0u; first < tileCount; first += uint(kCutScanGroup * kCutScanRows)) {
    uvec3 own[kCutScanRows];
    uvec3 sum = uvec3(0u);
    const uint at = first + me * uint(kCutScanRows);
    for (int row = 0; row < kCutScanRows; ++row) {
      own[row] = at + uint(row) < tileCount ? tiles[at + uint(row)].xyz : uvec3(0u);
      sum += own[row];
    }
    barrier();
    line[me] = sum;
    barrier();
    for (uint step2 = 1u; step2 < uint(kCutScanGroup); step2 *= 2u) {
      uvec3 upTo = line[me];
      if (me >= step2) upTo += line[me - step2];
      barrier();
      line[me] = upTo;
      barrier();
    }
    uvec3 here = before + line[me] - sum;
    for (int row = 0; row < kCutScanRows; ++row) {
      if (at + uint(row) < tileCount) tiles[at + uint(row)] = uvec4(here, 0u);
      here += own[row];
    }
    before += line[kCutScanGroup - 1];
  }
  if (me > 0u) return;
  const CutStep now = steps[step_];
  // Entries never become more than there were, plus one for each split.
  uint budget = capacity - now.finished - before.x;
  budget -= budget % splitsEach;
  const uint splits = min(before.y, budget);
  // Once the list is full, what it holds stays as it is.
  const bool full = before.y > budget;
#ifdef ORDERED
  const uint left = 0u;
#else
  const uint left = full ? 0u : before.z;
#endif
  const uint made = before.x + splits - left;
  steps[step_].budget = budget;
  steps[step_].full = full ? 1u : 0u;
  steps[step_].emitX = groupsFor(count, uint(kCutTile));
  steps[step_].emitY = steps[step_].emitZ = 1u;
  control.refused += before.y - splits;
  control.splits += splits;
  control.steps = step_ + 1u;
  control.count = now.finished + made;
  control.readAt = now.finishedAt;
  control.drawX = groupsFor(control.count, uint(kSplatGroup));
  control.drawY = control.drawZ = 1u;
#ifdef ORDERED
  const uint remaining = before.z;
#else
  const uint remaining = left;
#endif
  if (step_ < lastStep && (always != 0u || remaining > 0u)) {
    CutStep following = now;
    following.full = following.budget = 0u;
    following.emitX = following.emitY = following.emitZ = 0u;
    following.scanX = following.scanY = following.scanZ = 1u;
#ifdef ORDERED
    following.readAt = now.finishedAt;
    following.finishedAt = now.readAt;
    following.count = made;
#else
    following.readAt = now.leftAt;
    following.leftAt = now.readAt;
    following.finished = now.finished + made;
    following.count = left;
#endif
    following.classifyX = groupsFor(following.count, uint(kCutTile));
    following.classifyY = following.classifyZ = 1u;
    steps[step_ + 1u] = following;
  }
}
