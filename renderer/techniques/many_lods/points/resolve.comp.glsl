// SPDX-License-Identifier: BSD-3-Clause
// Picture of the nodes that a single view's pixels hold. FORM: of the atlas (view_atlas.h).
#include "renderer/many_lods/depth_packing.glsl"
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kPointsDepthsBuffer) readonly buffer Depths { uint depths[]; };
#if FORM == 1 || FORM == 3
layout(std430, binding = kPointsWinnersBuffer) readonly buffer Winners { uint winners[]; };
#endif
layout(std430, binding = kPointsColoursBuffer) readonly buffer Colours { uvec2 colours[]; };
layout(binding = kPointsImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx;
uniform vec3 background;

vec3 colourOf(uint node) {
  const uvec2 halves = colours[node];
  return vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const int at = pixel.y * sizePx.x + pixel.x;
  vec3 colour = background;
#if FORM == 1
  if (depths[at] != kAtlasEmpty) colour = colourOf(winners[at]);
#elif FORM == 2
  if (depths[2 * at + 1] != kAtlasEmpty) colour = colourOf(depths[2 * at]);
#else
  if (depths[at] != kAtlasEmpty) {
    const uint bits = unpackedColour(uvec2(depths[at], winners[at]));
    colour = vec3(bits & 255u, bits >> 8u & 255u, bits >> 16u) / 255.0;
  }
#endif
  imageStore(picture, pixel, vec4(colour, 1.0));
}
