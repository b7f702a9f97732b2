// SPDX-License-Identifier: BSD-3-Clause
// A stream and its reduction in storage buffers. LANES: words of an item, 1 or 2. FLAGGED: valid are the items whose
// flag is not 0.
#include "renderer/compute/reduction_bindings.h"

#if LANES == 1
#define ITEM uint
#define FIRST_WORD(item) (item)
#else
#define ITEM uvec2
#define FIRST_WORD(item) (item).x
#endif

layout(std430, binding = kReductionCountInBuffer) readonly buffer CountIn { uint countIn[]; };
layout(std430, binding = kReductionCountBuffer) buffer Count { ReducedCount reduced; };

uniform uint most, capacity, groupSize;
uniform int countAt;  // in words; < 0: there are `most` items

uint itemCount() { return countAt < 0 ? most : min(countIn[countAt], most); }

uint groupNumber() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

void finishCount(uint valid) {
  reduced.valid = valid;
  reduced.written = min(valid, capacity);
  reduced.lost = valid - reduced.written;
  // No dimension has more than 65,535.
  const uint groups = (reduced.written + groupSize - 1u) / groupSize;
  const uint rows = max((groups + 65534u) / 65535u, 1u);
  reduced.groupsX = (groups + rows - 1u) / rows;
  reduced.groupsY = rows;
  reduced.groupsZ = 1u;
}
