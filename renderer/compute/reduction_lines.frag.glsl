// SPDX-License-Identifier: BSD-3-Clause
// A texel of a block's line takes the item that lies `shift` further on: whole numbers, rather than an interpolated position.
#include "renderer/compute/reduction_bindings.h"

layout(binding = kReductionItemsUnit) uniform usamplerBuffer gathered;
uniform uint rowWidth;
#ifdef TWICE
#define SHIFT shift
#else
#define SHIFT itemShift
#endif
flat in uint SHIFT;
layout(location = 0) out uvec4 item;

void main() {
  const uvec2 texel = uvec2(gl_FragCoord.xy);
  item = texelFetch(gathered, int(texel.y * rowWidth + texel.x + SHIFT));
}
