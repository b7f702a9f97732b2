// SPDX-License-Identifier: BSD-3-Clause
// The open share as a grey picture.
#include "renderer/techniques/ambient_occlusion/occlusion_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kOcclusionPackedUnit) uniform sampler2D packedIn;
layout(binding = kOcclusionOutImage, rgba32f) uniform writeonly image2D outImage;
uniform ivec2 sizePx;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  imageStore(outImage, pixel, vec4(texelFetch(packedIn, pixel, 0).xxx, 1.0));
}
