// SPDX-License-Identifier: BSD-3-Clause
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "experiments/base/error.h"
#include "experiments/base/image_codec/checked_input.h"
#include "experiments/base/image_codec/functions.h"

namespace limen::codec {
namespace {

template <class T>
std::string encode(const std::string& format, const OIIO::ImageSpec& spec, const std::vector<T>& data) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput sink(bytes);
  const std::string name = "picture." + format;
  const auto out = OIIO::ImageOutput::create(name);
  if (!out || !out->set_ioproxy(&sink) || !out->open(name, spec) ||
      !out->write_image(OIIO::BaseTypeFromC<T>::value, data.data()) || !out->close())
    throw Error("a picture cannot be encoded as " + format + ": " +
                (out ? out->geterror() : OIIO::geterror()));
  return {bytes.begin(), bytes.end()};
}

std::vector<uint8_t> inBytes(const Image& image) {
  std::vector<uint8_t> bytes(image.data.size());
  std::transform(image.data.begin(), image.data.end(), bytes.begin(), [](float value) {
    return static_cast<uint8_t>(std::lround(255.0F * (value > 0.0F ? std::min(value, 1.0F) : 0.0F)));
  });
  return bytes;
}

}  // namespace

Image readImage(const std::string& path, const ImageLimits& limits) {
  const auto in = openChecked(path, limits);
  return readPixels(*in, in->spec(), path);
}

std::string encodeExr(const Image& image, const std::string& description) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  // Otherwise the library writes the time of day, and equal images would give different files.
  spec.attribute("DateTime", "");
  if (!description.empty()) spec.attribute("ImageDescription", description);
  return encode("exr", spec, image.data);
}

std::string encodePng(const Image& image, const std::string& description) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  if (!description.empty()) spec.attribute("ImageDescription", description);
  return encode("png", spec, inBytes(image));
}

std::string encodeJpeg(const Image& image, int quality) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", "jpeg:" + std::to_string(quality));
  spec.attribute("jpeg:subsampling", "4:4:4");
  return encode("jpg", spec, inBytes(image));
}

}  // namespace limen::codec
