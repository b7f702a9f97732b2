// SPDX-License-Identifier: BSD-3-Clause
// Between the passes of SampleRaster: empties the queue of large triangles and works out the groups of dispatches over the list.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kRasterQueueBuffer) buffer Queue { RasterQueueHeader queue; };
layout(std430, binding = kSampleRasterListBuffer) buffer List { SampleListHeader list; };

const uint kGroupsInRow = 32768u;  // a dimension has at most 65,535

void main() {
  queue.queued = 0u;
#ifdef EMPTY
  list.pixels = 0u;
#else
  const uint groups = (list.pixels + uint(kRasterGroup) - 1u) / uint(kRasterGroup);
  list.groupsX = min(groups, kGroupsInRow);
  list.groupsY = (groups + kGroupsInRow - 1u) / kGroupsInRow;
  list.groupsZ = 1u;
#endif
}
