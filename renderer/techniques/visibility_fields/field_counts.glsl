// SPDX-License-Identifier: BSD-3-Clause
// The count of an invocation's look-ups. The including shader declares `sizePx` before.
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

#ifdef COUNT
layout(std430, binding = kFieldCountsBuffer) buffer Counts { uint counts[]; };
#endif

void countLookUps(ivec2 pixel) {
#ifdef COUNT
  atomicAdd(counts[(pixel.y * sizePx.x + pixel.x) % kFieldCountSlots], fieldLookUps);
#endif
}
