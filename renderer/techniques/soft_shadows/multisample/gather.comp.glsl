// SPDX-License-Identifier: BSD-3-Clause
// Lists the pixels whose samples, by the driver's rasteriser, do not all see the centre's triangle, and copies these samples:
// what SampleRaster does for its own.
#include "renderer/frame/frame_bindings.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kSampleIdsBuffer) writeonly buffer SampleIds { uint ids[]; };
layout(std430, binding = kSampleListBuffer) buffer List {
  SampleListHeader list;
  uint listed[];  // pixels, by row
};
layout(binding = kGatherCentreIdsUnit) uniform usampler2D centreIds;
layout(binding = kGatherSamplesUnit) uniform usampler2DMS sampleIds;
layout(binding = kGatherMarksImage, r32ui) uniform writeonly uimage2D marks;
uniform ivec2 sizePx;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint centre = texelFetch(centreIds, pixel, 0).x;
  const int at = pixel.y * sizePx.x + pixel.x;
  bool differs = false;
  for (int i = 0; i < SAMPLES; ++i) {
    const uint id = texelFetch(sampleIds, pixel, i).x;
    ids[at * SAMPLES + i] = id;
    differs = differs || id != centre;
  }
  imageStore(marks, pixel, uvec4(differs ? 1u : 0u));
  if (differs) listed[atomicAdd(list.pixels, 1u)] = uint(at);
}
