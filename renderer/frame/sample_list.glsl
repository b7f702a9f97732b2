// SPDX-License-Identifier: BSD-3-Clause
// The pixels that SampleRaster listed, in an indirect dispatch over them.
// LANES: invocations per pixel, if several: lane k of a group's pixels are invocations k times kRasterGroup and following.
#include "renderer/frame/frame_bindings.h"

#ifndef LANES
#define LANES 1
#endif
layout(local_size_x = kRasterGroup * LANES) in;
layout(std430, binding = kSampleRasterListBuffer) readonly buffer List {
  SampleListHeader list;
  uint listed[];  // pixels, by row
};

// Place of this invocation's pixel in the list; list.pixels or more: none.
uint placeInList() {
  return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kRasterGroup + gl_LocalInvocationID.x % kRasterGroup;
}
