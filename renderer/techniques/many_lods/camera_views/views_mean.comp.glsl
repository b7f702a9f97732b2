// SPDX-License-Identifier: BSD-3-Clause
// Mean of what several views hold, each shifted in the picture, or, SIDE_BY_SIDE, two of them beside each other. FORM: of the atlas
// (view_atlas.h).
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kPointsDepthsBuffer) readonly buffer Depths { uint depths[]; };
#if FORM == 1
layout(std430, binding = kPointsWinnersBuffer) readonly buffer Winners { uint winners[]; };
#endif
layout(std430, binding = kPointsColoursBuffer) readonly buffer Colours { uvec2 colours[]; };
layout(binding = kCameraViewsUnit) uniform sampler2D viewRows;  // eye, axes of each view; w of the first two: shift
layout(binding = kPointsImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx, tilePx;
uniform int viewCount;
uniform vec2 tangents;
uniform vec3 backdrop;

vec3 held(int view, ivec2 at) {
  const int index = (view * tilePx.y + at.y) * tilePx.x + at.x;
#if FORM == 1
  if (depths[index] == kAtlasEmpty) return backdrop;
  const uint node = winners[index];
#else
  if (depths[2 * index + 1] == kAtlasEmpty) return backdrop;
  const uint node = depths[2 * index];
#endif
  const uvec2 halves = colours[node];
  return vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
#ifdef SIDE_BY_SIDE
  const int view = min(pixel.x / tilePx.x, 1);
  const vec3 colour = held(view, ivec2(min(pixel.x - view * tilePx.x, tilePx.x - 1), pixel.y));
#else
  vec3 colour = vec3(0.0);
  for (int view = 0; view < viewCount; ++view) {
    const vec2 shift = vec2(texelFetch(viewRows, ivec2(0, view), 0).w, texelFetch(viewRows, ivec2(1, view), 0).w);
    const vec2 at = vec2(pixel + (tilePx - sizePx) / 2) + 0.5 + 0.5 * shift / tangents * vec2(tilePx);
    colour += held(view, clamp(ivec2(floor(at)), ivec2(0), tilePx - 1));
  }
  colour /= float(viewCount);
#endif
  imageStore(picture, pixel, vec4(colour, 1.0));
}
