// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/comparator.h"

#include <algorithm>
#include <vector>

#include "perception/multiscale/plane.h"
#include "perception/popping/input.h"
#include "perception/vision/colour.h"

namespace limen::perception {

LargestColourDifference largestColourDifference(const PoppingInput& input, const DisplayProfile& display) {
  checkPoppingInput(input);
  checkDisplay(display, "popping");
  const int width = input.actual.width, height = input.actual.height;
  std::vector<LargestColourDifference> rows(static_cast<size_t>(height));
  const auto labAt = [&](const Image& image, int x, int y) {
    std::array<double, 3> light = pixelLight(input, image, display, x, y);
    for (double& value : light) value = std::min(value, 1.0);
    return labFromLinearRgb(light);
  };
  forRowBlocks(height, static_cast<size_t>(width) * 64, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      LargestColourDifference& row = rows[static_cast<size_t>(y)];
      row.y = y;
      for (int x = 0; x < width; ++x) {
        const double difference = differenceCie94(labAt(input.actual, x, y), labAt(input.predicted, x, y));
        if (difference > row.value) row.value = difference, row.x = x;
      }
    }
  });
  LargestColourDifference out;
  for (const LargestColourDifference& row : rows)
    if (row.value > out.value) out = row;
  return out;
}

}  // namespace limen::perception
