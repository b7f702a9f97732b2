// SPDX-License-Identifier: BSD-3-Clause
// Filters along columns, then compares: colour difference, feature difference, FLIP. Each invocation makes
// RUN pixels one above the other, so that a texel is fetched once for all of them. Out: the map, and each
// group's sum of it.
#include "perception/metrics/flip/flip_bindings.h"
#include "perception/metrics/flip/exact.glsl"
#include "perception/metrics/flip/filters.glsl"

layout(local_size_x = kFlipColumnsGroupX, local_size_y = kFlipColumnsGroupY) in;

layout(binding = kFlipColumnsTestSensitivityUnit) uniform sampler2D testSensitivity;
layout(binding = kFlipColumnsReferenceSensitivityUnit) uniform sampler2D referenceSensitivity;
layout(binding = kFlipColumnsDetectorsUnit) uniform sampler2D detectors;
layout(binding = kFlipColumnsSmoothedUnit) uniform sampler2D smoothed;
layout(binding = kFlipErrorMapImage, r32f) uniform writeonly image2D errorMap;
layout(binding = kFlipGroupSumsBuffer, std430) buffer GroupSums { float groupSums[]; };

const int kInvocations = kFlipColumnsGroupX * kFlipColumnsGroupY;
shared float sums[kInvocations];

// Opponent colour, filtered, to linear RGB, clamped to what a display can show.
vec3 toDisplayRgb(vec3 opponent) {
  // Inverse of the matrix to XYZ, to the digits that the published tool uses.
  const mat3 kRgbFromXyz = mat3(3.241003275, -0.969224334, 0.055639423,     //
                                -1.537398934, 1.875930071, -0.204011202,   //
                                -0.498615861, 0.041554224, 1.057148933);
  const vec3 kWhite = vec3(0.950428545, 1.0, 1.088900371);
  precise float y = (opponent.x + 16.0) * (1.0 / 116.0);
  precise vec3 xyz = vec3(fma(opponent.y, 1.0 / 500.0, y), y, fma(opponent.z, -1.0 / 200.0, y)) * kWhite;
  precise vec3 rgb = clamp(transform(kRgbFromXyz, xyz), 0.0, 1.0);
  return rgb;
}

// CIELAB with chroma scaled by lightness (Hunt effect).
vec3 toHuntLab(vec3 rgb) {
  const mat3 kXyzOverWhite = mat3(10135552.0 / 23359437.0, 2613072.0 / 12288897.0, 1425312.0 / 80288307.0,
                                  8788810.0 / 23359437.0, 8788810.0 / 12288897.0, 8788810.0 / 80288307.0,
                                  4435075.0 / 23359437.0, 887015.0 / 12288897.0, 70074185.0 / 80288307.0);
  const float kDelta = 6.0 / 29.0;
  precise vec3 xyz = transform(kXyzOverWhite, rgb);
  precise vec3 line = fma(xyz, vec3(1.0 / (3.0 * kDelta * kDelta)), vec3(4.0 / 29.0));
  precise vec3 root = pow(max(xyz, 1e-6), vec3(1.0 / 3.0));
  precise vec3 f = mix(line, root, greaterThan(xyz, vec3(kDelta * kDelta * kDelta)));
  precise float lightness = fma(116.0, f.y, -16.0);
  precise vec3 lab =
      vec3(lightness, (0.01 * lightness) * vec2(500.0 * (f.x - f.y), 200.0 * (f.y - f.z)));
  return lab;
}

float colourDistance(vec3 a, vec3 b) {  // HyAB
  precise vec3 difference = a - b;
  return abs(difference.x) + length(difference.yz);
}

// Colour distance raised to 0.7 and spread over [0, 1]: distances up to 0.4 of the largest possible one,
// that of green and blue, take the first 95 %.
float colourError(float distance) {
  if (distance == 0.0) return 0.0;
  float largest = pow(colourDistance(toHuntLab(vec3(0.0, 1.0, 0.0)), toHuntLab(vec3(0.0, 0.0, 1.0))), 0.7);
  float knee = 0.4 * largest;
  float raised = pow(distance, 0.7);
  return min(1.0, raised < knee ? 0.95 * raised / knee : 0.95 + 0.05 * (raised - knee) / (largest - knee));
}

// Texel `offset` below `top`; the image goes on as its edge.
vec4 fetchBelow(sampler2D source, ivec2 top, int offset) {
  return texelFetch(source, ivec2(top.x, clamp(top.y + offset, 0, textureSize(source, 0).y - 1)), 0);
}

void filterSensitivity(sampler2D source, ivec2 top, precise out vec3 lab[RUN]) {
  precise vec4 sum[RUN];
  for (int k = 0; k < RUN; ++k) sum[k] = vec4(0.0);
  for (int offset = -RADIUS; offset < RUN + RADIUS; ++offset) {
    vec4 value = fetchBelow(source, top, offset);
    for (int k = 0; k < RUN; ++k) {
      int tap = offset - k;
      if (abs(tap) <= RADIUS) sum[k] = fma(sensitivity[tap + RADIUS], value, sum[k]);
    }
  }
  for (int k = 0; k < RUN; ++k) {
    precise vec3 opponent = vec3(sum[k].xy, sum[k].z + sum[k].w);
    lab[k] = toHuntLab(toDisplayRgb(opponent));
  }
}

void main() {
  ivec2 size = textureSize(detectors, 0);
  int column = int(gl_GlobalInvocationID.x);
  ivec2 top = ivec2(min(column, size.x - 1), gl_GlobalInvocationID.y * RUN);

  precise vec3 testLab[RUN], referenceLab[RUN];
  filterSensitivity(testSensitivity, top, testLab);
  filterSensitivity(referenceSensitivity, top, referenceLab);

  // Edge and point detectors along x (x, y: edge, point of the test; z, w: of the reference) and along y.
  precise vec4 acrossSum[RUN], downSum[RUN];
  for (int k = 0; k < RUN; ++k) acrossSum[k] = downSum[k] = vec4(0.0);
  vec2 base = fetchBelow(smoothed, top, 0).xy;  // differences, for the reason given in the row pass
  for (int offset = -RADIUS; offset < RUN + RADIUS; ++offset) {
    vec4 across = fetchBelow(detectors, top, offset);
    precise vec2 down = fetchBelow(smoothed, top, offset).xy - base;
    for (int k = 0; k < RUN; ++k) {
      int tap = offset - k;
      if (abs(tap) <= RADIUS) {
        vec3 kernel = features[tap + RADIUS].xyz;
        acrossSum[k] = fma(kernel.xxxx, across, acrossSum[k]);
        downSum[k] = fma(kernel.yzyz, down.xxyy, downSum[k]);
      }
    }
  }

  float sum = 0.0;
  for (int k = 0; k < RUN; ++k) {
    precise vec4 strength = sqrt(fma(acrossSum[k], acrossSum[k], downSum[k] * downSum[k]));
    precise vec2 difference = abs(strength.xy - strength.zw);
    float featureError = sqrt(min(1.0, inversesqrt(2.0) * max(difference.x, difference.y)));
    float colour = colourError(colourDistance(testLab[k], referenceLab[k]));
    float flip = colour > 0.0 ? pow(colour, 1.0 - featureError) : 0.0;
    if (column < size.x && top.y + k < size.y) {
      imageStore(errorMap, ivec2(column, top.y + k), vec4(flip));
      sum += flip;
    }
  }

  uint index = gl_LocalInvocationIndex;
  sums[index] = sum;
  for (uint stride = kInvocations / 2; stride > 0u; stride /= 2u) {
    barrier();
    if (index < stride) sums[index] += sums[index + stride];
  }
  if (index == 0u) groupSums[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = sums[0];
}
