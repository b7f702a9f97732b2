// SPDX-License-Identifier: BSD-3-Clause
// Pyramid of nearest depths, all levels at once: each invocation takes 4 x 4 pixels, each group goes on from these in
// shared memory. Depths are reversed (near over distance): the nearest is the largest, and 0 is nothing.
#include "renderer/techniques/reflections/screen_space/screen_space_bindings.h"

layout(local_size_x = kScreenPyramidGroup, local_size_y = kScreenPyramidGroup) in;
layout(binding = kScreenPyramidDepthUnit) uniform sampler2D depths;
layout(binding = kScreenPyramid1Image, r32f) uniform writeonly image2D level1;
layout(binding = kScreenPyramid2Image, r32f) uniform writeonly image2D level2;
layout(binding = kScreenPyramid3Image, r32f) uniform writeonly image2D level3;
layout(binding = kScreenPyramid4Image, r32f) uniform writeonly image2D level4;
layout(binding = kScreenPyramid5Image, r32f) uniform writeonly image2D level5;
layout(binding = kScreenPyramid6Image, r32f) uniform writeonly image2D level6;
uniform ivec2 sizePx;

shared float tile[kScreenPyramidGroup][kScreenPyramidGroup];

float depthAt(ivec2 pixel) {
  return all(lessThan(pixel, sizePx)) ? texelFetch(depths, pixel, 0).x : 0.0;
}

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy), local = ivec2(gl_LocalInvocationID.xy);
  float nearest = 0.0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const ivec2 pair = 2 * at + ivec2(quarter & 1, quarter >> 1), pixel = 2 * pair;
    const float of = max(max(depthAt(pixel), depthAt(pixel + ivec2(1, 0))),
                         max(depthAt(pixel + ivec2(0, 1)), depthAt(pixel + ivec2(1, 1))));
    imageStore(level1, pair, vec4(of));
    nearest = max(nearest, of);
  }
  imageStore(level2, at, vec4(nearest));
  tile[local.y][local.x] = nearest;
  for (int level = 3; level <= kScreenPyramidLevels; ++level) {
    barrier();
    const int step = 1 << (level - 2), before = step >> 1;
    const bool reduces = all(equal(local & (step - 1), ivec2(0)));
    if (reduces) {
      nearest = max(max(tile[local.y][local.x], tile[local.y][local.x + before]),
                    max(tile[local.y + before][local.x], tile[local.y + before][local.x + before]));
      // Only this invocation reads this entry at this level and above.
      tile[local.y][local.x] = nearest;
      const ivec2 texel = at >> (level - 2);
      if (level == 3) imageStore(level3, texel, vec4(nearest));
      else if (level == 4) imageStore(level4, texel, vec4(nearest));
      else if (level == 5) imageStore(level5, texel, vec4(nearest));
      else imageStore(level6, texel, vec4(nearest));
    }
  }
}
