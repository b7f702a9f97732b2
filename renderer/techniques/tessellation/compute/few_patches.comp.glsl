// SPDX-License-Identifier: BSD-3-Clause
// Counts, offsets and totals of at most kFewPatches patches at once. One group. See compute.cpp.
#include "renderer/techniques/tessellation/counts_of_patch.glsl"
#include "renderer/techniques/tessellation/compute/totals.glsl"

layout(local_size_x = kFewPatches) in;
layout(std430, binding = kSlotOffsetsBuffer) writeonly buffer SlotOffsets { uvec2 slotOffsets[]; };

shared uvec2 line[2][kFewPatches];
shared uint seenPatches, fittingPatches;

void main() {
  const uint me = gl_LocalInvocationIndex;
  if (me == 0u) {
    seenPatches = 0u;
    fittingPatches = 0u;
  }
  // Of at most 64^2 vertices or twice as many triangles each: sums cannot overflow.
  const uvec2 own = me < patchCount ? patchCounts(me) : uvec2(0u);
  line[0][me] = own;
  barrier();
  if (own.x > 0u) atomicAdd(seenPatches, 1u);
  uint from = 0u;
  for (uint step_ = 1u; step_ < uint(kFewPatches); step_ *= 2u) {
    uvec2 sum = line[from][me];
    if (me >= step_) sum += line[from][me - step_];
    line[1u - from][me] = sum;
    from = 1u - from;
    barrier();
  }
  const uvec2 end = line[from][me];
  if (me < patchCount) {
    slotOffsets[me + 1u] = end;
    if (fits(end)) atomicAdd(fittingPatches, 1u);
  }
  barrier();
  if (me > 0u) return;
  slotOffsets[0] = uvec2(0u);
  const uint low = fittingPatches;
  // As samples of every place would find it.
  writeTotals(low, low == 0u ? uvec2(0u) : line[from][low - 1u], patchCount == 0u ? uvec2(0u) : line[from][patchCount - 1u],
              float(max(seenPatches, 1u)) / float(max(patchCount, 1u)));
}
