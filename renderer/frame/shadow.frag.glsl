// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/frame_bindings.h"

#ifdef PEEL
layout(binding = kPeelPreviousDepthUnit) uniform sampler2D previousDepth;
uniform float peelBias;

void main() {
  // Reversed depth: what lies behind is smaller.
  if (!(gl_FragCoord.z * (1.0 + peelBias) < texelFetch(previousDepth, ivec2(gl_FragCoord.xy), 0).x)) discard;
}
#else
void main() {}
#endif
