// SPDX-License-Identifier: BSD-3-Clause
// Visibility of each pixel: its own point's or, if it was listed, the mean over its samples. Samples that are no receivers
// count as lit, as they do in every visibility image. SINGLE: no samples, and nothing is listed.
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"
#include "renderer/techniques/soft_shadows/multisample/point_tiles.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSurfaceVisibilityUnit) uniform sampler2D visibility;  // of points
layout(binding = kSurfaceVisibilityImage, VISIBILITY_FORMAT) uniform writeonly image2D outVisibility;
#ifndef SINGLE
layout(binding = kSampleMarksUnit) uniform usampler2D marks;
layout(std430, binding = kSampleIdsBuffer) readonly buffer SampleIds { uint sources[]; };
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 own = texelFetch(visibility, pixel, 0);
  vec4 mean = own;
#ifndef SINGLE
  if (texelFetch(marks, pixel, 0).x != 0u) {
    const int at = (pixel.y * sizePx.x + pixel.x) * SAMPLES;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < SAMPLES; ++i) {
      const uint source = sources[at + i];
      if (source == kSourceNone)
        sum += 1.0;
      else
        sum += source == kSourceOwn ? own : texelFetch(visibility, furtherPoint(source - kSourcePoints), 0);
    }
    mean = sum / float(SAMPLES);
  }
#endif
  imageStore(outVisibility, pixel, mean);
}
