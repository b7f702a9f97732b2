// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/image.h"

#include "experiments/base/failure.h"
#include "experiments/base/image_codec/functions.h"
#include "experiments/base/image_file.h"

namespace limen {

namespace {

ImageLimits& limits() {
  static ImageLimits now;
  return now;
}

}  // namespace

const ImageLimits& imageLimits() { return limits(); }
void setImageLimits(const ImageLimits& wanted) { limits() = wanted; }

Image readImage(const std::string& path) {
  return namingFile(path, [&] { return codec::functions().read(path, limits()); });
}
void writeExr(const std::string& path, const Image& image, const std::string& description) {
  codec::functions().exr(path, image, description);
}
void writePng(const std::string& path, const Image& image, const std::string& description) {
  codec::functions().png(path, image, description);
}
ImageFile readImageFile(const std::string& path) {
  return namingFile(path, [&] { return codec::functions().readFile(path, limits()); });
}

std::string ImageFile::kind() const {
  return std::to_string(bits) + (integer ? "-bit " : "-bit float ") + format;
}

}  // namespace limen
