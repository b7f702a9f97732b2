// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/image_codec/checked_input.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::codec {
namespace {

namespace fs = std::filesystem;

/// Of a window's origin: differences of any two fit an int.
constexpr int kFarthest = 1 << 29;

void checkWindow(const std::string& what, int64_t width, int64_t height, int channels, double allowed,
                 const std::string& path, double bytes) {
  const double pixels = static_cast<double>(width) * static_cast<double>(height);
  const double samples = pixels * std::max(1.0, channels / 4.0);
  if (samples <= allowed) return;
  throw Error("'" + path + "' states a " + what + " of " + std::to_string(width) + " x " +
                  std::to_string(height) + " pixels and " + std::to_string(channels) +
                  " channels, which is too large for " + shortestNumber(bytes) + " bytes or beyond " +
                  shortestNumber(allowed / 1e6) + " megapixels",
              {}, "if it is right, allow it: limen perceive --max-megapixels N");
}

void checkHeader(const OIIO::ImageSpec& spec, const std::string& path, const ImageLimits& limits) {
  if (spec.deep || spec.depth > 1)
    throw Error("'" + path + "' is a deep or volumetric image", {}, "flatten it first");
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw Error("'" + path + "' has no pixels");
  for (const int place : {spec.x, spec.y, spec.full_x, spec.full_y})
    if (std::abs(static_cast<int64_t>(place)) > kFarthest)
      throw Error("'" + path + "' states a window that begins at " + std::to_string(place));
  std::error_code code;
  const auto bytes = static_cast<double>(fs::file_size(path, code));
  const double allowed = std::min(
      1e6 * limits.megapixels, 1e6 * limits.alwaysMegapixels + limits.pixelsPerByte * (code ? 0.0 : bytes));
  checkWindow("picture", spec.width, spec.height, spec.nchannels, allowed, path, bytes);
  checkWindow("display window", spec.full_width, spec.full_height, 4, allowed, path, bytes);
}

}  // namespace

std::string oneLine(std::string words) {
  while (!words.empty() && words.back() == '\n') words.pop_back();
  std::replace(words.begin(), words.end(), '\n', ' ');
  constexpr size_t kLongest = 300;  // a reader may complain of every row
  if (words.size() > kLongest) words = words.substr(0, kLongest) + " ...";
  return words;
}

std::unique_ptr<OIIO::ImageInput> openChecked(const std::string& path, const ImageLimits& limits,
                                              const OIIO::ImageSpec& wish) {
  std::error_code code;
  if (!fs::exists(path, code)) throw Error("no such image '" + path + "'", {}, "check the path");
  if (fs::is_directory(path, code))
    throw Error("'" + path + "' is a folder", {}, "name its images with a pattern: '" + path + "/*.png'");
  if (!fs::is_regular_file(path, code))
    throw Error("'" + path + "' is not a file but a pipe or a device", {}, "name an image file");
  auto in = OIIO::ImageInput::open(path, &wish);
  if (!in)
    throw Error("cannot read image '" + path + "': " + oneLine(OIIO::geterror()), {},
                "use PNG, JPEG, TIFF, EXR or HDR and check the path");
  checkHeader(in->spec(), path, limits);
  return in;
}

Image readPixels(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, const std::string& path) {
  Image raw(spec.width, spec.height, spec.nchannels);
  bool whole = in.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, raw.data.data());
  // Some readers fill in missing data and only leave a message.
  const std::string words = oneLine(in.geterror());
  whole = whole && words.empty();
  if (!whole)
    throw Error("cannot read image '" + path + "'" + (words.empty() ? "" : ": " + words), {},
                "is the file complete?");
  return raw;
}

}  // namespace limen::codec
