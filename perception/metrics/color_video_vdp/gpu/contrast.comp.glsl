// SPDX-License-Identifier: BSD-3-Clause
// Contrasts of all masked bands, times sensitivity: what test and reference have in common, which masks, and their
// difference. An invocation makes the pixels around one of the coarser level.
#include "perception/metrics/color_video_vdp/gpu/levels.glsl"
#include "perception/metrics/color_video_vdp/gpu/sensitivity.glsl"

layout(local_size_x = kCvvdpContrastGroupX, local_size_y = kCvvdpContrastGroupY) in;

layout(binding = kCvvdpContrastPyramidUnit) uniform sampler2DArray pyramid;
layout(binding = kCvvdpContrastMutualImage, rgba32f) uniform writeonly image2D mutual;
layout(binding = kCvvdpContrastChangeImage, rgba32f) uniform writeonly image2D change;

void even(vec4 before, vec4 here, vec4 after, out vec4 first, out vec4 second) {
  precise vec4 a = fma(vec4(0.8), here, 0.1 * (before + after));
  precise vec4 b = 0.5 * (here + after);
  first = a, second = b;
}

// The coarser level at four pixels: top left, top right, bottom left, bottom right.
void expandAround(int band, ivec2 coarse, int layer, out vec4 result[4]) {
  ivec2 origin = place[band + 1].xy, last = place[band + 1].zw - 1;
  vec4 left[3], right[3];
  for (int y = -1; y <= 1; ++y) {
    int row = clamp(coarse.y + y, 0, last.y);
    vec4 a = texelFetch(pyramid, ivec3(origin + ivec2(max(coarse.x - 1, 0), row), layer), 0);
    vec4 b = texelFetch(pyramid, ivec3(origin + ivec2(coarse.x, row), layer), 0);
    vec4 c = texelFetch(pyramid, ivec3(origin + ivec2(min(coarse.x + 1, last.x), row), layer), 0);
    even(a, b, c, left[y + 1], right[y + 1]);
  }
  even(left[0], left[1], left[2], result[0], result[2]);
  even(right[0], right[1], right[2], result[1], result[3]);
}

vec4 contrastOf(vec4 fine, vec4 coarse, float background, float multiplier) {
  precise vec4 contrast = min((fine - coarse) / background, vec4(limits.y)) * multiplier;
  return contrast;
}

void main() {
  int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
  if (group >= counts.y) return;
  int band = bandOf(group, 0);
  int inBand = group - groups[band].x;
  ivec2 tile = ivec2(inBand % groups[band].y, inBand / groups[band].y);
  ivec2 coarse = tile * ivec2(kCvvdpContrastGroupX, kCvvdpContrastGroupY) + ivec2(gl_LocalInvocationID.xy);
  ivec2 size = place[band].zw, origin = place[band].xy;
  if (any(greaterThanEqual(coarse, place[band + 1].zw))) return;

  vec4 testCoarse[4], referenceCoarse[4];
  expandAround(band, coarse, 0, testCoarse);
  expandAround(band, coarse, 1, referenceCoarse);
  float multiplier = band == 0 ? 1.0 : 2.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 pixel = 2 * coarse + ivec2(i & 1, i >> 1);
    if (any(greaterThanEqual(pixel, size))) continue;
    vec4 testFine = texelFetch(pyramid, ivec3(origin + pixel, 0), 0);
    vec4 referenceFine = texelFetch(pyramid, ivec3(origin + pixel, 1), 0);
    float testBackground = max(testCoarse[i].x, limits.x);
    float referenceBackground = max(referenceCoarse[i].x, limits.x);
    precise vec4 test = contrastOf(testFine, testCoarse[i], testBackground, multiplier);
    precise vec4 reference = contrastOf(referenceFine, referenceCoarse[i], referenceBackground, multiplier);
    vec4 sensitivity = sensitivityOf(band, referenceBackground);
    imageStore(mutual, origin + pixel, min(abs(test), abs(reference)) * sensitivity);
    imageStore(change, origin + pixel, abs(test - reference) * sensitivity);
  }
}
