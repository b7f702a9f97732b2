// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/half_space_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limen::techniques {

gl::Texture makeHalfSpaceTable(const std::vector<glm::dvec2>& samples, int size) {
  const size_t channels = samples.size() <= 64 ? 2 : 4, perLayer = 32 * channels;
  const size_t layers = (samples.size() + perLayer - 1) / perLayer, side = static_cast<size_t>(size);
  gl::Texture table(channels == 2 ? gl::Format::RG32UI : gl::Format::RGBA32UI, glm::ivec2(size), 1,
                    static_cast<int>(layers));
  const double step = 2.0 * std::numbers::sqrt2 / (size - 1);
  for (size_t layer = 0; layer < layers; ++layer) {
    const size_t first = layer * perLayer, end = std::min(first + perLayer, samples.size());
    std::vector<uint32_t> texels(side * side * channels, 0);
    const auto word = [&](size_t column, size_t row, size_t index) -> uint32_t& {
      return texels[(row * side + column) * channels + index];
    };
    for (size_t column = 0; column < side; ++column) {
      const double angle = std::numbers::pi * double(column) / size;
      const glm::dvec2 normal(-std::sin(angle), std::cos(angle));
      // A sample is in the masks of all rows up to the last one whose line it does not lie to the right of:
      // enter it there, then OR each row into the one before it.
      for (size_t b = first; b < end; ++b) {
        const double place = (glm::dot(normal, samples[b]) / step) + 0.5 * (size - 1);
        const double nearest = std::round(place);
        const bool onLine = std::abs(place - nearest) < 1e-9;
        const double last = onLine ? nearest - (column == 0 ? 1.0 : 0.0) : std::floor(place);
        const auto row = static_cast<size_t>(std::clamp(last, 0.0, double(size - 1)));
        if (last >= 0.0) word(column, row, (b - first) / 32) |= 1U << ((b - first) % 32);
      }
      for (size_t row = side - 1; row-- > 0;)
        for (size_t i = 0; i < channels; ++i) word(column, row, i) |= word(column, row + 1, i);
    }
    table.writeUint(texels, static_cast<int>(layer));
  }
  return table;
}

double halfSpaceTableError(int size) {
  return std::numbers::sqrt2 / (size - 1) + std::numbers::sqrt2 * std::numbers::pi / (2.0 * size);
}

}  // namespace limen::techniques
