// SPDX-License-Identifier: BSD-3-Clause
// Control points at a time. Points that are equal and move alike stay equal bit by bit. See factor_pass.h.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kPatchPointsBuffer) writeonly buffer PatchPoints { vec4 patchPoints[]; };
layout(std430, binding = kPointMotionsBuffer) readonly buffer Motions { PointMotion motions[]; };

uniform uint pointCount;
uniform vec2 wave;

void main() {
  const uint number = gl_GlobalInvocationID.x;
  if (number >= pointCount) return;
  const PointMotion motion = motions[number];
  precise const vec4 moved = motion.rest + (wave.x * motion.sine + wave.y * motion.cosine);
  patchPoints[number] = moved;
}
