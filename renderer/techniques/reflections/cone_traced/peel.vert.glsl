// SPDX-License-Identifier: BSD-3-Clause
// A pair at its pixel. See peeling.h.
#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"

layout(binding = kPeelKeysUnit) uniform usampler2D itemKeys;
layout(binding = kPeelColoursUnit) uniform sampler2D itemColours;
uniform ivec2 sizePx;
uniform uint itemRoom;
uniform float depthScale;
flat out vec4 itemColour;
flat out float itemDepth;

void main() {
  gl_PointSize = 1.0;
  gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside
  itemColour = vec4(0.0);
  itemDepth = 1.0;
  const uint index = uint(gl_VertexID);
  if (index >= itemRoom) return;
  const ivec2 at = ivec2(index % uint(kPeelItemsAcross), index / uint(kPeelItemsAcross));
  const uvec4 key = texelFetch(itemKeys, at, 0);
  itemColour = texelFetch(itemColours, at, 0);
  itemDepth = uintBitsToFloat(key.z) * depthScale;
  gl_Position = vec4((vec2(key.xy) + 0.5) / vec2(sizePx) * vec2(2.0, -2.0) + vec2(-1.0, 1.0), 0.5, 1.0);
}
