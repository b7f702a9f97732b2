// SPDX-License-Identifier: BSD-3-Clause
// For each level the fragments that reach it, in any order, an invocation a fragment.
#include "renderer/techniques/subdivision/fragments/fragment_bindings.h"

layout(local_size_x = kFragmentGroup) in;
layout(std430, binding = kFragmentLevelsBuffer) readonly buffer Levels { uint levels[]; };
layout(std430, binding = kFragmentListsBuffer) writeonly buffer Lists { uint lists[]; };
layout(std430, binding = kFragmentDispatchesBuffer) buffer Dispatches { FragmentDispatch dispatches[]; };
uniform uint fragmentCount;

void main() {
  const uint number = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(kFragmentGroup);
  if (number >= fragmentCount) return;
  const uint own = levels[number] & 15u;
  for (uint level = 0u; level <= own; ++level)
    lists[level * fragmentCount + atomicAdd(dispatches[level].listed, 1u)] = number;
}
