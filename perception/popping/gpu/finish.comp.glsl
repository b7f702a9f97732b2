// SPDX-License-Identifier: BSD-3-Clause
// Sigma and rating of each region from its sum.
#include "perception/popping/gpu/region_table.glsl"

layout(local_size_x = kRegionGroup) in;

uniform float threshold, exponent, ratingScale, ratingBase;

void main() {
  for (uint i = gl_GlobalInvocationID.x; i < table.regionCount; i += gl_NumWorkGroups.x * uint(kRegionGroup)) {
    float sum = 0.0;
    for (int word = 3; word >= 0; --word) sum = sum * 4294967296.0 + float(regions[i].sum[word]);
    float sigma = threshold * pow(sum * (1.0 / 65536.0), 1.0 / exponent);
    regions[i].sigma = sigma;
    regions[i].rating = log(ratingScale * sigma) / log(ratingBase);
  }
}
