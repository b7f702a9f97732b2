// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/base/image_file.h"

/// What the image library does. It pulls in hundreds of other libraries, a fifth of a second at every start,
/// so it is a module of its own that a program loads when it meets its first image file.
namespace limen::codec {

Image readImage(const std::string& path, const ImageLimits& limits);
void writeExr(const std::string& path, const Image& image, const std::string& description);
void writePng(const std::string& path, const Image& image, const std::string& description);
ImageFile readImageFile(const std::string& path, const ImageLimits& limits);

/// The functions above, as the module hands them out.
struct Functions {
  decltype(&readImage) read;
  decltype(&writeExr) exr;
  decltype(&writePng) png;
  decltype(&readImageFile) readFile;
};
inline constexpr const char* kEntry = "limenImageCodec";
using Entry = const Functions* (*)();

/// Loads the module, which lies beside the program. Throws Error if it does not.
const Functions& functions();

}  // namespace limen::codec
