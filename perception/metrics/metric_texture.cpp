// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/metric_texture.h"

#include <algorithm>

namespace limen::perception {

gl::Texture metricTexture(const Image& image) {
  const bool grey = image.channels == 1;
  gl::Texture texture(grey ? gl::Format::R32F : gl::Format::RGBA32F, {image.width, image.height});
  if (image.channels != 3) {
    texture.write(image);
    return texture;
  }
  Image padded(image.width, image.height, 4, 1.0F);
  for (size_t pixel = 0; pixel < image.pixels(); ++pixel)
    std::copy_n(image.data.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3,
                padded.data.begin() + static_cast<std::ptrdiff_t>(4 * pixel));
  texture.write(padded);
  return texture;
}

}  // namespace limen::perception
