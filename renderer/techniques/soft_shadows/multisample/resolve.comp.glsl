// SPDX-License-Identifier: BSD-3-Clause
// Mean visibility of a pixel's samples when only one of them was asked for. Schwarz 2009, section 4.6. Depths as
// select.comp.glsl writes them. Samples that are no receivers count as lit, as they do in every visibility image.
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampleResolveSampleDepthsUnit) uniform sampler2DArray sampleDepths;
layout(binding = kSampleResolveDepthsUnit) uniform sampler2D depths;      // of the samples that the visibility was found for
layout(binding = kSampleResolveVisibilityUnit) uniform sampler2D visibility;  // for those
layout(binding = kSampleResolveVisibilityImage, r32f) uniform writeonly image2D outVisibility;
#ifdef COUNT
// Samples that are receivers; of them, those that took a neighbour's visibility, those that took another surface's or none,
// and those on another surface than the pixel's.
layout(binding = kSampleResolveCountsImage, rgba32ui) uniform writeonly uimage2D outCounts;
#endif
uniform ivec2 sizePx;
uniform int samples, neighbours;
uniform float tolerance;   // difference of depth, relative to the sample's
uniform bool interpolate;  // false: all samples take the pixel's

// The four that share an edge come first, so that a corner wins only if it is closer in depth.
const ivec2 kOffsets[9] =
    ivec2[9](ivec2(0), ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1), ivec2(-1, -1), ivec2(1, -1), ivec2(-1, 1), ivec2(1, 1));

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const float own = texelFetch(depths, pixel, 0).x, ownVisibility = texelFetch(visibility, pixel, 0).x;
  const bool usable = own > 0.0;
  float sum = 0.0;
  uint receivers = 0u, borrowed = 0u, orphaned = 0u, apart = 0u;
  for (int k = 0; k < samples; ++k) {
    const float z = texelFetch(sampleDepths, ivec3(pixel, k), 0).x;
    if (!(z > 0.0)) {
      sum += 1.0;
      continue;
    }
    float nearest = usable ? abs(z - own) : 1e38, found = usable ? ownVisibility : 1.0;
    const bool same = nearest <= tolerance * z;
    bool other = false;
    if (interpolate && !same) {
      for (int i = 1; i <= neighbours; ++i) {
        const ivec2 at = pixel + kOffsets[i];
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, sizePx))) continue;
        const float theirs = texelFetch(depths, at, 0).x;
        if (theirs > 0.0 && abs(z - theirs) < nearest) {
          nearest = abs(z - theirs);
          found = texelFetch(visibility, at, 0).x;
          other = true;
        }
      }
    }
    ++receivers;
    apart += same ? 0u : 1u;
    borrowed += other ? 1u : 0u;
    orphaned += nearest <= tolerance * z ? 0u : 1u;
    sum += found;
  }
  imageStore(outVisibility, pixel, vec4(sum / float(samples)));
#ifdef COUNT
  imageStore(outCounts, pixel, uvec4(receivers, borrowed, orphaned, apart));
#endif
}
