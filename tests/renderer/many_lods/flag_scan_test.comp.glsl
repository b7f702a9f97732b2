// SPDX-License-Identifier: BSD-3-Clause
#if FLAG_SCAN == 1
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#elif FLAG_SCAN == 2
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_ARB_shader_ballot : require
#endif
#define FLAG_GROUP 256
#include "tests/renderer/many_lods/flag_scan_test_bindings.h"

layout(local_size_x = FLAG_GROUP) in;
#include "renderer/many_lods/flag_scan.glsl"
layout(std430, binding = kTestFlagsBuffer) readonly buffer Flags { uint flags[]; };
layout(std430, binding = kTestCountsBuffer) writeonly buffer Counts { uvec2 counts[]; };

void main() {
  uint total;
  const uint before = flagsBefore(flags[gl_GlobalInvocationID.x] != 0u, total);
  counts[gl_GlobalInvocationID.x] = uvec2(before, total);
}
