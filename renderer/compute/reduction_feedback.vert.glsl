// SPDX-License-Identifier: BSD-3-Clause
// An item of a stream as a point, for reduction_feedback.geom.glsl.
#include "renderer/compute/reduction_bindings.h"

layout(binding = kReductionItemsUnit) uniform usamplerBuffer items;
layout(binding = kReductionFlagsUnit) uniform usamplerBuffer flags;
layout(binding = kReductionCountUnit) uniform usamplerBuffer countIn;
uniform uint most;
uniform int countAt;

flat out uvec2 item;
flat out uint valid;

void main() {
  const uint count = countAt < 0 ? most : min(texelFetch(countIn, countAt).x, most);
  item = texelFetch(items, gl_VertexID).xy;
#ifdef FLAGGED
  const bool marked = texelFetch(flags, gl_VertexID).x != 0u;
#else
  const bool marked = item.x != kInvalidItem;
#endif
  valid = marked && uint(gl_VertexID) < count ? 1u : 0u;
  gl_Position = vec4(0.0);
}
