// SPDX-License-Identifier: BSD-3-Clause
// Copies an image: the most that memory can do, which the benchmark holds threshold maps against.
#include "perception/threshold_maps/threshold_map_bindings.h"

layout(local_size_x = kCopyGroupX, local_size_y = kCopyGroupY) in;
layout(binding = kCopySourceUnit) uniform sampler2D source;
layout(binding = kCopyImage, rgba32f) uniform writeonly image2D target;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(target)))) return;
  imageStore(target, at, texelFetch(source, at, 0));
}
