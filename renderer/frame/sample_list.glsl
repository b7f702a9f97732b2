// SPDX-License-Identifier: BSD-3-Clause
// The pixels that SampleRaster listed, in an indirect dispatch over them.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kRasterGroup) in;
layout(std430, binding = kSampleRasterListBuffer) readonly buffer List {
  SampleListHeader list;
  uint listed[];  // pixels, by row
};

// Place of this invocation in the list; list.pixels or more: none.
uint placeInList() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kRasterGroup + gl_LocalInvocationID.x; }
