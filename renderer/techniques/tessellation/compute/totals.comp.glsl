// SPDX-License-Identifier: BSD-3-Clause
// The totals from the offsets of all patches. One group. See totals.glsl.
uniform uint patchCount;
#include "renderer/techniques/tessellation/compute/totals.glsl"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kSlotOffsetsBuffer) readonly buffer SlotOffsets { uvec2 slotOffsets[]; };

shared uint sampledPatches;

void main() {
  const uint local = gl_LocalInvocationIndex;
  if (local == 0u) sampledPatches = 0u;
  barrier();
  // Share of patches that are not culled, from samples.
  const uint place = uint((float(local) + 0.5) / float(kTessellationGroup) * float(patchCount));
  if (place < patchCount && slotOffsets[place + 1u].x > slotOffsets[place].x) atomicAdd(sampledPatches, 1u);
  barrier();
  if (local > 0u) return;
  const uvec2 needed = slotOffsets[patchCount];
  uint low = 0u, high = patchCount;
  if (fits(needed)) low = patchCount;
  while (low < high) {
    const uint middle = (low + high + 1u) / 2u;
    if (fits(slotOffsets[middle])) {
      low = middle;
    } else {
      high = middle - 1u;
    }
  }
  writeTotals(low, slotOffsets[low], needed, float(max(sampledPatches, 1u)) / float(kTessellationGroup));
}
