// SPDX-License-Identifier: BSD-3-Clause
// The thesis's form of the count: fragments that survive are counted by an occlusion query.
#include "renderer/techniques/perceptual_lod/lod_difference.glsl"

uniform int counted;  // 0: covered, 1: visible, 2: next visible
layout(location = 0) out float unused;

void main() {
  const Seen seen = look(ivec2(gl_FragCoord.xy));
  if (!(counted == 0 ? seen.covered : counted == 1 ? seen.visible : seen.nextVisible)) discard;
  unused = 1.0;
}
