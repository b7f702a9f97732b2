// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace limen::perception {

/// Connected components of the pixels that are not 0 in `mask` (row by row): 0 outside, otherwise a label
/// from 1 on, in order of the components' first pixels. `connectivity` is 4 or 8. By OpenCV.
std::vector<uint32_t> connectedComponents(const std::vector<uint8_t>& mask, int width, int height,
                                          int connectivity);

}  // namespace limen::perception
