// SPDX-License-Identifier: BSD-3-Clause
#include "perception/image_analysis/connected_components.h"

#include <cassert>
#include <limits>

#include "perception/image_analysis/functions.h"

namespace limen::perception {

std::vector<uint32_t> connectedComponents(const std::vector<uint8_t>& mask, int width, int height,
                                          int connectivity) {
  const size_t pixels = static_cast<size_t>(width) * height;
  assert(mask.size() == pixels && (connectivity == 4 || connectivity == 8) &&
         pixels < static_cast<size_t>(std::numeric_limits<int32_t>::max()));
  if (pixels == 0) return {};
  std::vector<int32_t> found(pixels);
  analysis::functions().label(mask.data(), width, height, connectivity, found.data());
  std::vector<uint32_t> labels(pixels, 0), numbers;
  uint32_t count = 0;
  for (size_t pixel = 0; pixel < pixels; ++pixel) {
    if (found[pixel] == 0) continue;
    const auto label = static_cast<size_t>(found[pixel]);
    if (numbers.size() <= label) numbers.resize(label + 1, 0);
    if (numbers[label] == 0) numbers[label] = ++count;
    labels[pixel] = numbers[label];
  }
  return labels;
}

}  // namespace limen::perception
