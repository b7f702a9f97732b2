// SPDX-License-Identifier: BSD-3-Clause
// Phase 2: of a common side the larger factor; vertices and indices of each patch. See factor_pass.h.
#include "renderer/techniques/tessellation/counts_of_patch.glsl"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kSlotCountsBuffer) writeonly buffer SlotCounts { uvec2 slotCounts[]; };

void main() {
  const uint number = gl_GlobalInvocationID.x;
  if (number < patchCount) slotCounts[number] = patchCounts(number);
}
