// SPDX-License-Identifier: BSD-3-Clause
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/base/image_codec/checked_input.h"
#include "experiments/base/image_codec/functions.h"

namespace limen::codec {
namespace {

template <class T>
void writeAtomically(const std::string& path, const OIIO::ImageSpec& spec, const std::vector<T>& data) {
  const std::filesystem::path target(path);
  // A reader or a second sweep must never see half a file.
  const std::filesystem::path partial =
      target.parent_path() / ("." + std::to_string(::getpid()) + "-" + target.filename().string());
  const auto refuse = [&](const std::string& words) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    return Error("cannot write '" + path + "'" + (words.empty() ? "" : ": " + words), {},
                 "check that the folder is writable and the disk has room");
  };
  std::error_code code;
  if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path(), code);
  if (code) throw refuse(code.message());
  {
    const auto out = OIIO::ImageOutput::create(partial.string());
    if (!out || !out->open(partial.string(), spec) ||
        !out->write_image(OIIO::BaseTypeFromC<T>::value, data.data()) || !out->close())
      throw refuse(out ? out->geterror() : "");
  }
  std::filesystem::rename(partial, target, code);
  if (code) throw refuse(code.message());
}

}  // namespace

Image readImage(const std::string& path, const ImageLimits& limits) {
  const auto in = openChecked(path, limits);
  const OIIO::ImageSpec spec = in->spec();
  Image image(spec.width, spec.height, spec.nchannels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.data.data()))
    throw Error("cannot read image '" + path + "': " + oneLine(in->geterror()), {}, "is the file complete?");
  return image;
}

void writeExr(const std::string& path, const Image& image, const std::string& description) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  // Otherwise the library writes the time of day, and equal images would give different files.
  spec.attribute("DateTime", "");
  if (!description.empty()) spec.attribute("ImageDescription", description);
  writeAtomically(path, spec, image.data);
}

void writePng(const std::string& path, const Image& image, const std::string& description) {
  std::vector<uint8_t> bytes(image.data.size());
  std::transform(image.data.begin(), image.data.end(), bytes.begin(), [](float value) {
    return static_cast<uint8_t>(std::lround(255.0F * (value > 0.0F ? std::min(value, 1.0F) : 0.0F)));
  });
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  if (!description.empty()) spec.attribute("ImageDescription", description);
  writeAtomically(path, spec, bytes);
}

}  // namespace limen::codec
