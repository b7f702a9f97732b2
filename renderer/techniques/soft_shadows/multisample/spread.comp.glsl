// SPDX-License-Identifier: BSD-3-Clause
// All samples as pixels of one tall picture, sample k of every pixel in the k-th picture from the top; and back: their mean.
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"
#ifndef MEAN
#include "renderer/techniques/soft_shadows/multisample/sample_ids.glsl"
#endif

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
uniform ivec2 sizePx;
#ifdef MEAN
layout(binding = kSampleSpreadVisibilityUnit) uniform sampler2D visibility;
layout(binding = kSampleSpreadVisibilityImage, r32f) uniform writeonly image2D outVisibility;
#else
layout(binding = kSamplePointIdsImage, r32ui) uniform writeonly uimage2D outIds;
layout(binding = kSamplePlacesImage, rg32f) uniform writeonly image2D outPlaces;
uniform vec2 samplePlaces[SAMPLES];
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
#ifdef MEAN
  float sum = 0.0;
  for (int i = 0; i < SAMPLES; ++i) sum += texelFetch(visibility, pixel + ivec2(0, i * sizePx.y), 0).x;
  imageStore(outVisibility, pixel, vec4(sum / float(SAMPLES)));
#else
  for (int i = 0; i < SAMPLES; ++i) {
    const ivec2 at = pixel + ivec2(0, i * sizePx.y);
    imageStore(outIds, at, uvec4(sampleId(pixel, i)));
    imageStore(outPlaces, at, vec4(vec2(pixel) + samplePlaces[i], 0.0, 0.0));
  }
#endif
}
