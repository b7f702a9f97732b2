// SPDX-License-Identifier: BSD-3-Clause
// Between 0 and 1, evenly spread over the image: the additive sequence of the plastic number in two dimensions (Roberts
// 2018), in integers so that it is the same everywhere.
float ditherThreshold(ivec2 pixel) {
  const uint turn = uint(pixel.x) * 3242174889u + uint(pixel.y) * 2447445414u;
  return (float(turn >> 8) + 0.5) / 16777216.0;
}
