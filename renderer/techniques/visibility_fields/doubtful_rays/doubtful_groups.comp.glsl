// SPDX-License-Identifier: BSD-3-Clause
// Work groups over the list of doubtful rays, or none if there were more than fit; empties the list for the next frame.
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kDoubtListBuffer) buffer DoubtList { DoubtListHeader doubtList; };
uniform uint doubtCapacity;

const uint kGroupsInRow = 32768u;  // a dimension has at most 65,535

void main() {
  doubtList.found = doubtList.rays;
  doubtList.most = max(doubtList.most, doubtList.found);
  doubtList.overflow = doubtList.found > doubtCapacity ? 1u : 0u;
  doubtList.listed = doubtList.overflow != 0u ? 0u : doubtList.found;
  doubtList.rays = 0u;
  const uint groups = (doubtList.listed + uint(kDoubtGroup) - 1u) / uint(kDoubtGroup);
  doubtList.groupsX = min(groups, kGroupsInRow);
  doubtList.groupsY = (groups + kGroupsInRow - 1u) / kGroupsInRow;
  doubtList.groupsZ = 1u;
}
