// SPDX-License-Identifier: BSD-3-Clause
// Length of a list that transform feedback has captured, from counts of its passes: entries that went on, then those that were
// finished. See feedback_cuts.h.
#include "renderer/many_lods/cut_lists.glsl"

layout(local_size_x = 1) in;
layout(std430, binding = kCutTilesBuffer) readonly buffer Counts { uint counts[]; };

uniform uint passes;

void main() {
  uint finished = 0u, steps_ = 0u;
  bool lost = false;
  for (uint i = 0u; i < passes; ++i) {
    if (counts[2u * i] + counts[2u * i + 1u] > 0u) steps_ = i + 1u;
    // Nothing says how much was not captured.
    lost = lost || counts[2u * i] >= capacity;
    finished += counts[2u * i + 1u];
  }
  control.count = min(finished, capacity);
  control.readAt = 0u;
  control.refused = lost || finished >= capacity ? 1u : 0u;
  control.splits = control.tests = control.merges = 0u;
  control.steps = steps_;
  control.drawX = groupsFor(control.count, uint(kSplatGroup));
  control.drawY = control.drawZ = 1u;
}
