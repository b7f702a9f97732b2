// SPDX-License-Identifier: BSD-3-Clause
// Bit 0: an edge between a pixel and the one below; bit 1: between it and the one to its right.
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kFilterColoursUnit) uniform sampler2D colours;
layout(binding = kFilterEdgesImage, r32ui) uniform writeonly uimage2D outEdges;

uniform ivec2 sizePx;
uniform float threshold;
#include "renderer/techniques/antialiasing/displayed_luma.glsl"

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const float here = lumaAt(pixel);
  const bool below = abs(lumaAt(pixel + ivec2(0, 1)) - here) > threshold,
             right = abs(lumaAt(pixel + ivec2(1, 0)) - here) > threshold;
  imageStore(outEdges, pixel, uvec4((below ? 1u : 0u) | (right ? 2u : 0u), 0u, 0u, 0u));
}
