// SPDX-License-Identifier: BSD-3-Clause
// The nearest pair of a pixel that is farther than the last layer. The first layer is the beginning of the picture: light
// times its share; others wait to be blended.
#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"

layout(binding = kPeelPreviousUnit) uniform sampler2D previousDepth;
uniform bool first;
flat in vec4 itemColour;
flat in float itemDepth;
layout(location = 0) out vec4 outColour;

void main() {
  if (!first && itemDepth <= texelFetch(previousDepth, ivec2(gl_FragCoord.xy), 0).x) discard;
  gl_FragDepth = itemDepth;
  outColour = first ? vec4(itemColour.a * itemColour.rgb, itemColour.a) : itemColour;
}
