// SPDX-License-Identifier: BSD-3-Clause
// Copies an image: the most that memory can do, which the benchmark holds threshold maps against.
layout(local_size_x = 32, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D source;
layout(binding = 0, rgba32f) uniform writeonly image2D target;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(target)))) return;
  imageStore(target, at, texelFetch(source, at, 0));
}
