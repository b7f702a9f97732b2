// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/image.h"

#include <filesystem>
#include <system_error>

#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/image_codec/functions.h"
#include "experiments/base/image_file.h"
#include "experiments/base/input_files.h"
#include "experiments/base/replace_file.h"

namespace limen {
namespace {

void write(const std::string& path, const std::string& bytes) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code code;
  if (!folder.empty()) std::filesystem::create_directories(folder, code);
  if (code)
    throw Error("the folder cannot be made: " + code.message(), folder.string(),
                "check the path and its rights");
  replaceFile(path, bytes);
}

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
  write(path, codec::functions().exr(image, description));
}
void writePng(const std::string& path, const Image& image, const std::string& description) {
  write(path, codec::functions().png(image, description));
}
ImageFile readImageFile(const std::string& path) {
  protectInput(path);
  return namingFile(path, [&] { return codec::functions().readFile(path, limits()); });
}

std::string ImageFile::kind() const {
  return std::to_string(bits) + (integer ? "-bit " : "-bit float ") + format;
}

}  // namespace limen
