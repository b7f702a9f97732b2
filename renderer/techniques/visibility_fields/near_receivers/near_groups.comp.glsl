// SPDX-License-Identifier: BSD-3-Clause
// Work groups over the list of receivers near an object, one for each; empties the list for the next frame.
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kNearListBuffer) buffer NearList { NearListHeader nearList; };

const uint kGroupsInRow = 32768u;  // a dimension has at most 65,535

void main() {
  nearList.listed = nearList.pixels;
  nearList.pixels = 0u;
  nearList.groupsX = min(nearList.listed, kGroupsInRow);
  nearList.groupsY = (nearList.listed + kGroupsInRow - 1u) / kGroupsInRow;
  nearList.groupsZ = 1u;
}
