// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace limen {

/// Float image in memory: row by row from the top left, channels interleaved.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> data;

  Image() = default;
  Image(int w, int h, int c, float value = 0.0F)
      : width(w), height(h), channels(c), data(static_cast<size_t>(w) * h * c, value) {}

  size_t pixels() const { return static_cast<size_t>(width) * height; }
  float& at(int x, int y, int c = 0) { return data[(static_cast<size_t>(y) * width + x) * channels + c]; }
  float at(int x, int y, int c = 0) const {
    return data[(static_cast<size_t>(y) * width + x) * channels + c];
  }
};

/// How large an image may be that is read. A header of a few bytes can state any size.
struct ImageLimits {
  double megapixels = 256.0;       ///< of data and display window each; four channels to a pixel
  double pixelsPerByte = 16384.0;  ///< of the file: more than any compression makes of an empty picture
  double alwaysMegapixels = 1.0;   ///< whatever the file's size
};
const ImageLimits& imageLimits();
/// For all images from now on; before any is read.
void setImageLimits(const ImageLimits& limits);

/// Reads any format that OpenImageIO knows; 8- and 16-bit integers become [0, 1]. Throws Error naming the
/// file: no regular file, not an image, incomplete, beyond imageLimits(), too little memory.
Image readImage(const std::string& path);
/// EXR, 32-bit float, lossless. Encoded in memory and written as PartFile does. `description` goes into the
/// file, for those who find it without its context. Throws Error.
void writeExr(const std::string& path, const Image& image, const std::string& description = {});
/// 8-bit PNG of values in [0, 1], stored as they are (no transfer curve); others are clamped. Otherwise as
/// writeExr().
void writePng(const std::string& path, const Image& image, const std::string& description = {});

}  // namespace limen
