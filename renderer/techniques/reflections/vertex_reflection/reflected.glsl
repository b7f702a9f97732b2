// SPDX-License-Identifier: BSD-3-Clause
// Which vertices may be drawn. POLICY: what becomes of triangles with a vertex that has no reflection.
#include "renderer/techniques/reflections/vertex_reflection/secant.glsl"

bool usable(vec4 found) {
  const uint outcome = outcomeOfStatus(statusOf(found));
#if POLICY == POLICY_CLAMP
  return outcome != kOutcomeNoSurface;
#else
  return outcome == kOutcomeFound || outcome == kOutcomeUnconverged;
#endif
}
