// SPDX-License-Identifier: BSD-3-Clause
// Contrast sensitivity of a band by the logarithm of its background: log2 of the sensitivity of each channel, gain
// included.
layout(binding = kCvvdpSensitivityBuffer, std430) readonly buffer SensitivityTable { vec4 sensitivityTable[]; };

vec4 sensitivityOf(int band, float background) {
  const float kLast = float(kCvvdpSensitivityLevels - 1);
  precise float position = clamp((log2(background) - sensitivityGrid.x) * sensitivityGrid.y, 0.0, kLast);
  int node = int(min(position, kLast - 1.0));
  vec4 low = sensitivityTable[band * kCvvdpSensitivityLevels + node];
  vec4 high = sensitivityTable[band * kCvvdpSensitivityLevels + node + 1];
  return exp2(mix(low, high, position - float(node)));
}
