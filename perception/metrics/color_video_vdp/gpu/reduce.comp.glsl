// SPDX-License-Identifier: BSD-3-Clause
// The next coarser level of both signals. Columns first, then rows, as the authors' program, whose rule for the right
// border depends on the number of rows.
#include "perception/metrics/color_video_vdp/gpu/levels.glsl"

layout(local_size_x = kCvvdpReduceGroup, local_size_y = kCvvdpReduceGroup) in;

layout(binding = kCvvdpReducePyramidUnit) uniform sampler2DArray pyramid;
layout(binding = kCvvdpReducePyramidImage, rgba32f) uniform writeonly image2DArray coarser;

uniform int level;  // that is made
uniform bool referenceBorders;

const int kTile = 2 * kCvvdpReduceGroup + 3;
shared vec4 fine[kTile][kTile];
shared vec4 down[kCvvdpReduceGroup][kTile];

// Half-sample symmetric.
int symmetric(int i, int n) {
  i = i < 0 ? -i - 1 : i;
  i = i >= n ? 2 * n - 1 - i : i;
  return clamp(i, 0, n - 1);
}

vec4 weighted(vec4 a, vec4 b, vec4 c, vec4 d, vec4 e) {
  precise vec4 sum = fma(vec4(0.4), c, fma(vec4(0.25), b + d, 0.05 * (a + e)));
  return sum;
}

void main() {
  ivec2 size = place[level - 1].zw, coarseSize = place[level].zw;
  ivec2 group = ivec2(gl_WorkGroupID.xy) * kCvvdpReduceGroup;
  ivec2 local = ivec2(gl_LocalInvocationID.xy);
  int layer = int(gl_WorkGroupID.z);
  ivec2 first = 2 * group - 2;
  for (int i = int(gl_LocalInvocationIndex); i < kTile * kTile; i += kCvvdpReduceGroup * kCvvdpReduceGroup) {
    ivec2 at = ivec2(i % kTile, i / kTile);
    ivec2 source = first + at;
    bool beyond = referenceBorders && source.x >= size.x;
    source = ivec2(symmetric(source.x, size.x), symmetric(source.y, size.y));
    fine[at.y][at.x] =
        beyond ? vec4(0.0) : texelFetch(pyramid, ivec3(place[level - 1].xy + source, layer), 0);
  }
  barrier();
  for (int i = int(gl_LocalInvocationIndex); i < kTile * kCvvdpReduceGroup;
       i += kCvvdpReduceGroup * kCvvdpReduceGroup) {
    int x = i % kTile, y = i / kTile;
    down[y][x] = weighted(fine[2 * y][x], fine[2 * y + 1][x], fine[2 * y + 2][x], fine[2 * y + 3][x],
                          fine[2 * y + 4][x]);
  }
  barrier();
  ivec2 pixel = group + local;
  if (any(greaterThanEqual(pixel, coarseSize))) return;
  int x = 2 * local.x;
  precise vec4 sum = weighted(down[local.y][x], down[local.y][x + 1], down[local.y][x + 2],
                              down[local.y][x + 3], down[local.y][x + 4]);
  if (referenceBorders && pixel.x == coarseSize.x - 1) {
    int last = size.x - 1 - first.x;
    vec4 end = down[local.y][last];
    sum += size.y % 2 == 1 ? fma(vec4(0.25), end, 0.05 * down[local.y][last - 1]) : 0.05 * end;
  }
  imageStore(coarser, ivec3(place[level].xy + pixel, layer), sum);
}
