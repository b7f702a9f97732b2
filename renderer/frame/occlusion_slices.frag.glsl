// SPDX-License-Identifier: BSD-3-Clause
// Marks the slice that a fragment lies in.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/shadow_depth.glsl"

layout(binding = kSlicesBitsImage, r32ui) uniform uimage2D outBits;
uniform float near, begin, slicesPerDepth;
uniform int slices;

void main() {
  const float slice = (linearDepth(gl_FragCoord.z, near) - begin) * slicesPerDepth;
  // Rounding may put what lies on the near plane before the first slice; nothing else gets there.
  if (slice < float(slices)) imageAtomicOr(outBits, ivec2(gl_FragCoord.xy), 1u << uint(max(slice, 0.0)));
}
