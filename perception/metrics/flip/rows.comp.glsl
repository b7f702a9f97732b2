// SPDX-License-Identifier: BSD-3-Clause
// Filters both images along their rows. Out: the four parts of contrast sensitivity of each image, and the
// feature detectors' and their Gaussian's answers of both.
#include "perception/metrics/flip/flip_bindings.h"
#include "perception/metrics/flip/exact.glsl"
#include "perception/metrics/flip/filters.glsl"

layout(local_size_x = kFlipRowsGroupX, local_size_y = kFlipRowsGroupY) in;

layout(binding = kFlipRowsTestImageUnit) uniform sampler2D testImage;
layout(binding = kFlipRowsReferenceImageUnit) uniform sampler2D referenceImage;
layout(binding = kFlipRowsTestSensitivityImage, rgba32f) uniform writeonly image2D testSensitivity;
layout(binding = kFlipRowsReferenceSensitivityImage, rgba32f) uniform writeonly image2D referenceSensitivity;
layout(binding = kFlipRowsDetectorsImage, rgba32f) uniform writeonly image2D detectors;  // test edge, point; reference edge, point
layout(binding = kFlipRowsSmoothedImage, rg32f) uniform writeonly image2D smoothed;     // test, reference

uniform bool grey;  // visibility: one channel

const int kWidth = kFlipRowsGroupX + 2 * RADIUS;
shared vec3 testRow[kFlipRowsGroupY][kWidth];  // Y, Cx, Cz
shared vec3 referenceRow[kFlipRowsGroupY][kWidth];

// Linear RGB to YCxCz, the opponent space of the filters: XYZ over the white's XYZ, then as CIELAB without
// its roots.
vec3 toOpponent(vec3 rgb) {
  const mat3 kXyzOverWhite = mat3(10135552.0 / 23359437.0, 2613072.0 / 12288897.0, 1425312.0 / 80288307.0,
                                  8788810.0 / 23359437.0, 8788810.0 / 12288897.0, 8788810.0 / 80288307.0,
                                  4435075.0 / 23359437.0, 887015.0 / 12288897.0, 70074185.0 / 80288307.0);
  precise vec3 xyz = transform(kXyzOverWhite, rgb);
  precise vec3 opponent =
      vec3(fma(116.0, xyz.y, -16.0), 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z));
  return opponent;
}

// By the bits, since a compiler may take isnan() for false.
bvec3 isNonFinite(vec3 v) { return equal(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u)); }

void filterRow(int row, int centre, bool isTest, precise out vec4 sensitivitySum,
               precise out vec3 featureSum) {
  vec3 middle = isTest ? testRow[row][centre] : referenceRow[row][centre];
  sensitivitySum = sensitivity[RADIUS] * middle.xyzz;
  // The detectors' weights sum to zero, so they are applied to differences: a flat image then answers
  // exactly zero, and the square root taken of the answer later has no rounding to blow up.
  featureSum = vec3(features[RADIUS].x * middle.x, 0.0, 0.0);
  for (int tap = 1; tap <= RADIUS; ++tap) {
    vec3 left = isTest ? testRow[row][centre - tap] : referenceRow[row][centre - tap];
    vec3 right = isTest ? testRow[row][centre + tap] : referenceRow[row][centre + tap];
    precise vec3 both = left + right;
    precise vec3 differences = vec3(both.x, right.x - left.x, (left.x - middle.x) + (right.x - middle.x));
    sensitivitySum = fma(sensitivity[RADIUS + tap], both.xyzz, sensitivitySum);
    featureSum = fma(features[RADIUS + tap].xyz, differences, featureSum);
  }
  // Features are sought in luminance scaled to [0, 1].
  featureSum = fma(featureSum, vec3(1.0 / 116.0), vec3(16.0 / 116.0, 0.0, 0.0));
}

void main() {
  ivec2 size = textureSize(testImage, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  int row = int(gl_LocalInvocationID.y);
  int first = int(gl_WorkGroupID.x) * kFlipRowsGroupX - RADIUS;
  for (int i = int(gl_LocalInvocationID.x); i < kWidth; i += kFlipRowsGroupX) {
    ivec2 source = clamp(ivec2(first + i, pixel.y), ivec2(0), size - 1);
    vec3 test = texelFetch(testImage, source, 0).rgb;
    vec3 reference = texelFetch(referenceImage, source, 0).rgb;
    if (grey) {
      test = test.rrr;
      reference = reference.rrr;
    }
    // The clamped linear values are what a display makes of their sRGB code: no need to encode and decode.
    reference = clamp(reference, 0.0, 1.0);
    test = mix(clamp(test, 0.0, 1.0), vec3(lessThan(reference, vec3(0.5))), isNonFinite(test));
    testRow[row][i] = toOpponent(test);
    referenceRow[row][i] = toOpponent(reference);
  }
  barrier();
  if (any(greaterThanEqual(pixel, size))) return;

  int centre = int(gl_LocalInvocationID.x) + RADIUS;
  vec4 sensitivitySum;
  vec3 testFeatures, referenceFeatures;
  filterRow(row, centre, true, sensitivitySum, testFeatures);
  imageStore(testSensitivity, pixel, sensitivitySum);
  filterRow(row, centre, false, sensitivitySum, referenceFeatures);
  imageStore(referenceSensitivity, pixel, sensitivitySum);
  imageStore(detectors, pixel, vec4(testFeatures.yz, referenceFeatures.yz));
  imageStore(smoothed, pixel, vec4(testFeatures.x, referenceFeatures.x, 0.0, 0.0));
}
