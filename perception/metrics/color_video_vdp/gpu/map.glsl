// SPDX-License-Identifier: BSD-3-Clause
// A pixel's differences of all channels as one: the fourth root of the sum of fourth powers, offset as all powers.
float shareOfMap(vec4 difference, vec4 weight) {
  float offset2 = limits.z * limits.z, offset4 = offset2 * offset2;
  vec4 x = weight * difference + limits.z;
  vec4 x2 = x * x;
  float sum = max(dot(x2, x2) - 4.0 * offset4, 0.0);
  return max(sqrt(sqrt(sum + limits.z)) - sqrt(sqrt(limits.z)), 0.0);
}
