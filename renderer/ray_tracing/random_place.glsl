// SPDX-License-Identifier: BSD-3-Clause
// Random places for rays: the same for the same numbers, on any device.

// The hash "pcg3d" (Jarzynski and Olano 2020), in [0, 1).
vec2 randomPlace(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return vec2(v.xy >> 8u) / 16777216.0;
}
