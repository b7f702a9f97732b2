// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/base/image_file.h"

/// What the image library does. It pulls in hundreds of other libraries, which takes a fifth of a second at
/// start-up, so it is a separate module that a program loads when it first needs an image file.
namespace limen::codec {

Image readImage(const std::string& path, const ImageLimits& limits);
/// Bytes of a file. Encoded in memory, so that a full disk cannot truncate a picture unnoticed.
std::string encodeExr(const Image& image, const std::string& description);
std::string encodePng(const Image& image, const std::string& description);
/// 1 or 3 channels of values in [0, 1], stored as they are; chroma is not subsampled.
std::string encodeJpeg(const Image& image, int quality);
ImageFile readImageFile(const std::string& path, const ImageLimits& limits);

/// The functions above, as the module exports them.
struct Functions {
  decltype(&readImage) read;
  decltype(&encodeExr) exr;
  decltype(&encodePng) png;
  decltype(&encodeJpeg) jpeg;
  decltype(&readImageFile) readFile;
};
inline constexpr const char* kEntry = "limenImageCodec";
using Entry = const Functions* (*)();

/// Loads the module, which is installed beside the program. Throws Error if it is missing.
const Functions& functions();

}  // namespace limen::codec
