// SPDX-License-Identifier: BSD-3-Clause
// Between two steps: what was written becomes what is read, and how many groups that takes.
#include "renderer/compute/reduction_bindings.h"
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kHierarchyControlBuffer) buffer Control { HierarchyControl control; };

uniform uint capacity, level, raysPerLeaf, mode;
uniform uint regions;  // that share the groups without room
uniform uint batch;  // whose overflow is noted
uniform bool isLeaf;
#ifdef SPARSE
layout(std430, binding = kHierarchyReducedBuffer) readonly buffer Reduced { ReducedCount reduced; };
#endif
#ifdef SPILL
uniform uint spillCapacity;
#endif

uint rowsOf(uint groups) { return (groups + kDispatchRow - 1u) / kDispatchRow; }
uint groupsOf(uint items) { return (items + uint(kTraversalGroup) - 1u) / uint(kTraversalGroup); }

void main() {
  uint inputs = 0u;
  control.previousInputs = control.inputs;
  if (mode == kControlStep) {
#ifdef SPARSE
    inputs = reduced.written;
#else
    inputs = min(min(control.outputs, control.limit), capacity);
#endif
    control.pairsAt[level] += inputs;
    if (isLeaf) control.leafPairs += inputs;
  } else {
    control.left = 0u;
  }
#ifdef SPILL
  if (mode != kControlStep) {
    if (mode == kControlLaterBatch) {
      inputs = min(min(control.spilled, control.spillLimit), spillCapacity);
      control.spilledEver += inputs;
      control.laterBatches += inputs > 0u ? 1u : 0u;
    }
    control.spilled = 0u;
    control.spillLimit = kHierarchyNoTriangle;
  }
#endif
  control.inputs = inputs;
  control.outputs = 0u;
  control.limit = kHierarchyNoTriangle;
#ifdef SPARSE
  // Pairs from `capacity` on, a whole number of groups, are followed at once, before the others are expanded.
  const uint taken = min(inputs, capacity);
  control.previousInputs = inputs;
  control.sparseItems = 4u * taken;
  const uint expand = groupsOf(taken), finish = isLeaf ? 0u : groupsOf(inputs - taken);
#else
  const uint expand = groupsOf(inputs), finish = control.left;
#endif
  const uint resolve = groupsOf(inputs * raysPerLeaf);
  control.expandX = min(expand, kDispatchRow);
  control.expandY = rowsOf(expand);
  control.expandZ = 1u;
  control.resolveX = min(resolve, kDispatchRow);
  control.resolveY = rowsOf(resolve);
  control.resolveZ = 1u;
  control.finishX = min(finish, kDispatchRow);
  control.finishY = rowsOf(finish);
  control.finishZ = regions;
  control.finishGroups = finish;
  control.leftEver += finish;
  if (finish > 0u) control.batchLeft[batch] += finish;
  control.left = 0u;
}
