// SPDX-License-Identifier: BSD-3-Clause
// Works out the groups of dispatches over the triangles that SampleRaster keeps, SMALL_LANES invocations each.
// EMPTY: keeps none.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kSampleRasterKeptBuffer) buffer Kept { SampleListHeader kept; };

void main() {
#ifdef EMPTY
  kept.pixels = 0u;
#else
  const uint perGroup = uint(kRasterGroup), inRow = kRasterRowInvocations / perGroup;
  const uint groups = (kept.pixels * uint(SMALL_LANES) + perGroup - 1u) / perGroup;
  kept.groupsX = min(groups, inRow);
  kept.groupsY = (groups + inRow - 1u) / inRow;
  kept.groupsZ = 1u;
#endif
}
