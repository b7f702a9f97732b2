// SPDX-License-Identifier: BSD-3-Clause
// Fragments of one segment a side from the refined control mesh, an invocation a point.
#include "renderer/techniques/subdivision/fragments/fragment_bindings.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(local_size_x = kFragmentGroup) in;
layout(std430, binding = kFragmentTargetBuffer) writeonly buffer Target { vec4 target[]; };
layout(std430, binding = kFragmentControlsBuffer) readonly buffer ControlNumbers { uint controlNumbers[]; };
layout(std430, binding = kControlsBuffer) readonly buffer Controls { vec4 controls[]; };  // ControlVertex
uniform uint pointCount;

void main() {
  const uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(kFragmentGroup);
  if (i < pointCount) target[i] = vec4(controls[2u * controlNumbers[i]].xyz, 0.0);
}
