// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/base/image_file.h"

/// What the image library does. It pulls in hundreds of other libraries, a fifth of a second at every start,
/// so it is a module of its own that a program loads when it meets its first image file.
namespace limen::codec {

Image readImage(const std::string& path);
/// Bytes of a file. Encoded in memory, so that a full disk cannot cut a picture unnoticed.
std::string encodeExr(const Image& image, const std::string& description);
std::string encodePng(const Image& image, const std::string& description);
ImageFile readImageFile(const std::string& path);

/// The functions above, as the module hands them out.
struct Functions {
  decltype(&readImage) read;
  decltype(&encodeExr) exr;
  decltype(&encodePng) png;
  decltype(&readImageFile) readFile;
};
inline constexpr const char* kEntry = "limenImageCodec";
using Entry = const Functions* (*)();

/// Loads the module, which lies beside the program. Throws Error if it does not.
const Functions& functions();

}  // namespace limen::codec
