// SPDX-License-Identifier: BSD-3-Clause
// Between the passes of SampleRaster: empties the queue of large triangles and works out the groups of dispatches over the list.
// NO_QUEUE: of CentreSamples, which has none.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = 1) in;
#ifndef NO_QUEUE
layout(std430, binding = kRasterQueueBuffer) buffer Queue { RasterQueueHeader queue; };
#endif
layout(std430, binding = kSampleRasterListBuffer) buffer List { SampleListHeader list; };

const uint kGroupsInRow = 32768u;  // a dimension has at most 65,535

void main() {
#ifndef NO_QUEUE
  queue.queued = 0u;
#endif
#ifdef EMPTY
  list.pixels = 0u;
#else
  const uint groups = (list.pixels + uint(kRasterGroup) - 1u) / uint(kRasterGroup);
  list.groupsX = min(groups, kGroupsInRow);
  list.groupsY = (groups + kGroupsInRow - 1u) / kGroupsInRow;
  list.groupsZ = 1u;
#endif
}
