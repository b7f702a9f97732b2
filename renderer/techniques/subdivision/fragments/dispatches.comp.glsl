// SPDX-License-Identifier: BSD-3-Clause
// Groups for the steps to a level and for its limits, an invocation a level; `listed` is copied, and cleared for the next frame.
#include "renderer/techniques/subdivision/fragments/fragment_bindings.h"

layout(local_size_x = kFragmentGroup) in;
layout(std430, binding = kFragmentDispatchesBuffer) buffer Dispatches { FragmentDispatch dispatches[]; };
uniform uint mostLevel, ringPoints;

void main() {
  const uint level = gl_LocalInvocationIndex;
  if (level > mostLevel) return;
  const uint count = dispatches[level].listed, n = 1u << level, group = uint(kFragmentGroup);
  // As FragmentRefinement::dispatch() does: in rows where there are many.
  const uint steps = (count * ((n + 3u) * (n + 3u) + ringPoints) + group - 1u) / group;
  const uint limits = (count * (n + 1u) * (n + 1u) + group - 1u) / group;
  const uint stepRows = (steps + 65534u) / 65535u, limitRows = (limits + 65534u) / 65535u;
  dispatches[level].stepGroups = uvec3(stepRows > 0u ? (steps + stepRows - 1u) / stepRows : 0u, stepRows, 1u);
  dispatches[level].limitGroups = uvec3(limitRows > 0u ? (limits + limitRows - 1u) / limitRows : 0u, limitRows, 1u);
  dispatches[level].count = count;
  dispatches[level].listed = 0u;
}
