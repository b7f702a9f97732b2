// SPDX-License-Identifier: BSD-3-Clause
// Triangle that a sample sees, from where PixelSamples has it.
// SINGLE: one sample a pixel, behind its centre. LISTED: samples of listed pixels alone, others as their centres. Otherwise: a
// multisampled texture of the driver's.
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"

#if defined(SINGLE)
layout(binding = kSampleIdsUnit) uniform usampler2D sampleIds;
uint sampleId(ivec2 pixel, int i) { return texelFetch(sampleIds, pixel, 0).x; }
#elif defined(LISTED)
layout(binding = kSampleIdsUnit) uniform usampler2D centreIds;
layout(binding = kSampleMarksUnit) uniform usampler2D marks;
layout(std430, binding = kSampleIdsBuffer) readonly buffer SampleIds { uint listedIds[]; };
uint sampleId(ivec2 pixel, int i) {
  if (texelFetch(marks, pixel, 0).x == 0u) return texelFetch(centreIds, pixel, 0).x;
  return listedIds[(pixel.y * textureSize(marks, 0).x + pixel.x) * SAMPLES + i];
}
#else
layout(binding = kSampleIdsUnit) uniform usampler2DMS sampleIds;
uint sampleId(ivec2 pixel, int i) { return texelFetch(sampleIds, pixel, i).x; }
#endif
