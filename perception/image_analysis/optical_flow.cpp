// SPDX-License-Identifier: BSD-3-Clause
#include "perception/image_analysis/optical_flow.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

#include "perception/image_analysis/functions.h"

namespace limen::perception {
namespace {

/// Rec. 709 luma in 8 bits; grey as it is.
std::vector<uint8_t> lumaOf(const Image& image) {
  std::vector<uint8_t> out(image.pixels());
  const auto channels = static_cast<size_t>(image.channels);
  for (size_t pixel = 0; pixel < out.size(); ++pixel) {
    const float* value = &image.data[pixel * channels];
    const float luma = channels < 3 ? value[0] : 0.2126F * value[0] + 0.7152F * value[1] + 0.0722F * value[2];
    out[pixel] = static_cast<uint8_t>(std::lround(255.0F * (luma > 0.0F ? std::min(luma, 1.0F) : 0.0F)));
  }
  return out;
}

}  // namespace

Image opticalFlow(const Image& before, const Image& now) {
  assert(before.width == now.width && before.height == now.height && now.width > 0 && now.height > 0);
  Image displacement(now.width, now.height, 2);
  analysis::functions().trace(lumaOf(before).data(), lumaOf(now).data(), now.width, now.height,
                              displacement.data.data());
  for (float& value : displacement.data) value = std::isfinite(value) ? -value : 0.0F;
  return displacement;
}

}  // namespace limen::perception
