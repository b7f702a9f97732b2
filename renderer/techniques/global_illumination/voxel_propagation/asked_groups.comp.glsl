// SPDX-License-Identifier: BSD-3-Clause
// Work groups over a list whose length the GPU alone knows.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kAskedRaysBuffer) buffer AskedRays { AskedHeader asked; };
uniform uint mostRays;
uniform bool searches;  // the list of pixels that search; else the others

const uint kGroupsInRow = 32768u;  // a dimension has at most 65,535

void setGroups(inout AskedList list, uint most) {
  list.listed = min(list.count, most);
  list.count = 0u;
  const uint groups = (list.listed + uint(kAskedGroup) - 1u) / uint(kAskedGroup);
  list.groupsX = min(groups, kGroupsInRow);
  list.groupsY = (groups + kGroupsInRow - 1u) / kGroupsInRow;
  list.groupsZ = 1u;
}

void main() {
  if (searches) {
    setGroups(asked.searches, ~0u);
  } else {
    setGroups(asked.rays, mostRays);
    setGroups(asked.pixels, ~0u);
  }
}
