// SPDX-License-Identifier: BSD-3-Clause
// Of each vertex, its place in the square of the region that trims its patch. See trim_pass.h.
#include "renderer/techniques/tessellation/compute/slots.glsl"

layout(std430, binding = kPatchTrimsBuffer) readonly buffer Trims { PatchTrimRecord trims[]; };
layout(std430, binding = kTrimPlacesBuffer) writeonly buffer Places { vec4 trimPlaces[]; };  // z: region; -1: none

// u, v, 1 - u, 1 - v.
vec4 pointOfSlot(uint number, uint shape, PatternPlan plan, int slot) {
  const ivec4 s = patternSample(plan, slot);
#if SPACING >= 2 && SPACING != 5
  return spacedPoint(shape, s, SPACING, unitsOf(number));
#else
  return domainPoint(shape, s);
#endif
}

void main() {
  for (uint slot = gl_GlobalInvocationID.x; slot < totals.vertices; slot += invocationCount()) {
    const uint number = patchAt(slot, 0, 0u, totals.patches - 1u);
    const PatchTrimRecord trim = trims[number];
    if (trim.region < 0) {
      trimPlaces[slot] = vec4(0.0, 0.0, -1.0, 0.0);
      continue;
    }
    const uint shape = shapeOf(patches[number]);
    const vec4 at = pointOfSlot(number, shape, planOf(number, shape), int(slot - slotOffsets[number].x));
    trimPlaces[slot] = vec4(trim.low * at.zw + trim.high * at.xy, float(trim.region), 0.0);
  }
}
