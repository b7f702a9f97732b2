// SPDX-License-Identifier: BSD-3-Clause
// Masked differences of all masked bands and the sums of their pooled powers by group. WITH_MAP: also the band's share
// of the map.
#include "perception/metrics/color_video_vdp/gpu/levels.glsl"
#include "perception/metrics/color_video_vdp/gpu/map.glsl"

layout(local_size_x = kCvvdpMaskTileX, local_size_y = kCvvdpMaskTileY / kCvvdpMaskRun) in;

layout(binding = kCvvdpMaskMutualUnit) uniform sampler2D mutual;
layout(binding = kCvvdpMaskChangeUnit) uniform sampler2D change;
#ifdef WITH_MAP
layout(binding = kCvvdpMaskMapImage, r32f) uniform writeonly image2D map;
#endif
layout(binding = kCvvdpSumsBuffer, std430) writeonly buffer Sums { vec4 groupSums[]; };

const int kInvocations = kCvvdpMaskTileX * kCvvdpMaskTileY / kCvvdpMaskRun;
const int kRows = kCvvdpMaskTileY + 2 * kCvvdpBlurRadius;
const int kColumns = kCvvdpMaskTileX + 2 * kCvvdpBlurRadius;
const int kRun = 4;  // pixels of a row that an invocation blurs at a time
// Rows are one longer than needed, so that neighbours in a column lie in different banks.
shared vec4 maskers[kRows][kColumns + 1];
shared vec4 across[kRows][kCvvdpMaskTileX + 1];
shared vec4 sums[kInvocations];

float tap(int offset) {
  int i = abs(offset);
  return blurTaps[i >> 2][i & 3];
}

// Mirrored at the border samples. Small levels are not blurred: any sample will do.
int reflected(int i, int n) {
  i = abs(i);
  i = i >= n ? 2 * n - 2 - i : i;
  return clamp(i, 0, n - 1);
}

float maskExponent() { return masking.x; }
float maskScale() { return masking.y; }
float largestDifference() { return masking.z; }

vec4 maskedDifference(vec4 masker, vec4 difference) {
  vec4 elevation = vec4(0.0);
  for (int k = 0; k < 4; ++k)
    elevation += crossMasking[k] * offsetPower(maskScale() * masker[k], maskerExponent[k], maskerOffset[k]);
  vec4 result;
  for (int c = 0; c < 4; ++c) {
    float masked = offsetPower(difference[c], maskExponent(), limits.w) / (1.0 + elevation[c]);
    result[c] = largestDifference() * masked / (largestDifference() + masked);
  }
  return result;
}

void main() {
  int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
  if (group >= counts.z) return;
  int band = bandOf(group, 2);
  int inBand = group - groups[band].z;
  ivec2 origin = place[band].xy, size = place[band].zw;
  ivec2 first = ivec2(inBand % groups[band].w, inBand / groups[band].w) * ivec2(kCvvdpMaskTileX, kCvvdpMaskTileY);
  bool blurred = min(size.x, size.y) > kCvvdpBlurRadius;
  int index = int(gl_LocalInvocationIndex);

  for (int i = index; i < kRows * kColumns; i += kInvocations) {
    ivec2 at = ivec2(i % kColumns, i / kColumns);
    ivec2 source = first + at - kCvvdpBlurRadius;
    maskers[at.y][at.x] = texelFetch(mutual, origin + ivec2(reflected(source.x, size.x), reflected(source.y, size.y)), 0);
  }
  barrier();
  if (blurred) {
    for (int task = index; task < kRows * (kCvvdpMaskTileX / kRun); task += kInvocations) {
      int row = task % kRows, column = task / kRows * kRun;
      vec4 sum[kRun];
      for (int k = 0; k < kRun; ++k) sum[k] = vec4(0.0);
      for (int offset = 0; offset < kRun + 2 * kCvvdpBlurRadius; ++offset) {
        vec4 value = maskers[row][column + offset];
        for (int k = 0; k < kRun; ++k)
          if (abs(offset - k - kCvvdpBlurRadius) <= kCvvdpBlurRadius)
            sum[k] += tap(offset - k - kCvvdpBlurRadius) * value;
      }
      for (int k = 0; k < kRun; ++k) across[row][column + k] = sum[k];
    }
  }
  barrier();

  int column = int(gl_LocalInvocationID.x), top = int(gl_LocalInvocationID.y) * kCvvdpMaskRun;
  vec4 masker[kCvvdpMaskRun];
  if (blurred) {
    for (int k = 0; k < kCvvdpMaskRun; ++k) masker[k] = vec4(0.0);
    for (int offset = 0; offset < kCvvdpMaskRun + 2 * kCvvdpBlurRadius; ++offset) {
      vec4 value = across[top + offset][column];
      for (int k = 0; k < kCvvdpMaskRun; ++k)
        if (abs(offset - k - kCvvdpBlurRadius) <= kCvvdpBlurRadius)
          masker[k] += tap(offset - k - kCvvdpBlurRadius) * value;
    }
  } else {
    for (int k = 0; k < kCvvdpMaskRun; ++k)
      masker[k] = maskers[top + k + kCvvdpBlurRadius][column + kCvvdpBlurRadius];
  }

  vec4 sum = vec4(0.0);
  for (int k = 0; k < kCvvdpMaskRun; ++k) {
    ivec2 pixel = first + ivec2(column, top + k);
    if (any(greaterThanEqual(pixel, size))) continue;
    vec4 difference = maskedDifference(masker[k], texelFetch(change, origin + pixel, 0));
    sum += difference * (difference + 2.0 * limits.z);  // (d + e)^2 - e^2
#ifdef WITH_MAP
    imageStore(map, origin + pixel, vec4(shareOfMap(difference, mapWeight[0]) / (band == 0 ? 1.0 : 2.0)));
#endif
  }
  sums[index] = sum;
  for (int stride = kInvocations / 2; stride > 0; stride /= 2) {
    barrier();
    if (index < stride) sums[index] += sums[index + stride];
  }
  if (index == 0) groupSums[group] = sums[0];
}
