// SPDX-License-Identifier: BSD-3-Clause
// Between two steps: what was written becomes what is read, and how many groups that takes.
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kHierarchyControlBuffer) buffer Control { HierarchyControl control; };

uniform uint capacity, level, raysPerLeaf;
uniform uint batch;  // whose overflow is noted; kHierarchyNoTriangle: nobody's
uniform bool begins, isLeaf;

uint rowsOf(uint groups) { return (groups + kDispatchRow - 1u) / kDispatchRow; }
uint groupsOf(uint items) { return (items + uint(kTraversalGroup) - 1u) / uint(kTraversalGroup); }

void main() {
  uint inputs = 0u;
  if (begins) {
    control.inputs = 0u;
    control.left = 0u;
  } else {
    inputs = min(min(control.outputs, control.limit), capacity);
    control.pairsAt[level] += inputs;
    if (isLeaf) control.leafPairs += inputs;
  }
  control.previousInputs = control.inputs;
  control.inputs = inputs;
  control.outputs = 0u;
  control.limit = kHierarchyNoTriangle;
  const uint expand = groupsOf(inputs), resolve = groupsOf(inputs * raysPerLeaf), finish = control.left;
  control.expandX = min(expand, kDispatchRow);
  control.expandY = rowsOf(expand);
  control.expandZ = 1u;
  control.resolveX = min(resolve, kDispatchRow);
  control.resolveY = rowsOf(resolve);
  control.resolveZ = 1u;
  control.finishX = min(finish, kDispatchRow);
  control.finishY = rowsOf(finish);
  control.finishZ = 1u;
  control.finishGroups = finish;
  control.leftEver += finish;
  if (finish > 0u) control.batchLeft[batch] += finish;
  control.left = 0u;
}
