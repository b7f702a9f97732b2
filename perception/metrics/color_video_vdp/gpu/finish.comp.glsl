// SPDX-License-Identifier: BSD-3-Clause
// Means of the pooled powers: a group for each masked band adds up the groups' sums; the last makes the base band, whose
// contrast is relative to each signal's mean luminance. In an order that does not vary.
#include "perception/metrics/color_video_vdp/gpu/levels.glsl"
#include "perception/metrics/color_video_vdp/gpu/map.glsl"
#include "perception/metrics/color_video_vdp/gpu/sensitivity.glsl"

layout(local_size_x = kCvvdpFinishGroup) in;

layout(binding = kCvvdpFinishPyramidUnit) uniform sampler2DArray pyramid;
#ifdef WITH_MAP
layout(binding = kCvvdpFinishMapImage, r32f) uniform writeonly image2D map;
#endif
layout(binding = kCvvdpSumsBuffer, std430) readonly buffer Sums { vec4 groupSums[]; };
layout(binding = kCvvdpResultsBuffer, std430) writeonly buffer Results { vec4 results[]; };

uniform int resultRow;  // of this frame: first of its bands

shared vec4 sums[kCvvdpFinishGroup];

// Of all invocations' values.
vec4 total(vec4 value) {
  int index = int(gl_LocalInvocationIndex);
  barrier();
  sums[index] = value;
  for (int stride = kCvvdpFinishGroup / 2; stride > 0; stride /= 2) {
    barrier();
    if (index < stride) sums[index] += sums[index + stride];
  }
  barrier();
  return sums[0];
}

void main() {
  int band = int(gl_WorkGroupID.x), index = int(gl_LocalInvocationIndex);
  ivec2 origin = place[band].xy, size = place[band].zw;
  int pixels = size.x * size.y;
  vec4 sum = vec4(0.0);
  if (band < counts.x - 1) {
    int first = groups[band].z, end = band + 1 < counts.x - 1 ? groups[band + 1].z : counts.z;
    for (int group = first + index; group < end; group += kCvvdpFinishGroup) sum += groupSums[group];
  } else {
    vec2 light = vec2(0.0);
    for (int i = index; i < pixels; i += kCvvdpFinishGroup) {
      ivec2 at = origin + ivec2(i % size.x, i / size.x);
      light += max(vec2(texelFetch(pyramid, ivec3(at, 0), 0).x, texelFetch(pyramid, ivec3(at, 1), 0).x), limits.x);
    }
    precise vec2 mean = total(vec4(light, 0.0, 0.0)).xy / float(pixels);
    vec4 sensitivity = sensitivityOf(band, mean.y);
    for (int i = index; i < pixels; i += kCvvdpFinishGroup) {
      ivec2 at = origin + ivec2(i % size.x, i / size.x);
      precise vec4 test = min(texelFetch(pyramid, ivec3(at, 0), 0) / mean.x, vec4(limits.y));
      precise vec4 reference = min(texelFetch(pyramid, ivec3(at, 1), 0) / mean.y, vec4(limits.y));
      vec4 difference = abs(test - reference) * sensitivity;
      sum += difference * (difference + 2.0 * limits.z);
#ifdef WITH_MAP
      imageStore(map, at, vec4(shareOfMap(difference, mapWeight[1])));
#endif
    }
  }
  vec4 all = total(sum);
  if (index == 0) results[resultRow + band] = all / float(pixels);
}
