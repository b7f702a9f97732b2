// SPDX-License-Identifier: BSD-3-Clause
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/image_codec/checked_input.h"
#include "experiments/base/image_codec/functions.h"
#include "experiments/base/text.h"

namespace limen::codec {
namespace {

struct Channels {
  std::vector<int> colour;  ///< 1 or 3
  int alpha = -1;
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Which channels make up the picture. Names decide where they can: an EXR may hold depth and normals as
/// well.
Channels pickChannels(const OIIO::ImageSpec& spec, const std::string& path) {
  const auto find = [&](std::initializer_list<const char*> names) {
    for (int c = 0; c < spec.nchannels; ++c)
      for (const char* name : names)
        if (lower(spec.channelnames[static_cast<size_t>(c)]) == name) return c;
    return -1;
  };
  Channels picked;
  // The reader of GIF names a fourth channel where there are three.
  const bool stated = spec.alpha_channel >= 0 && spec.alpha_channel < spec.nchannels;
  picked.alpha = stated ? spec.alpha_channel : find({"a", "alpha"});
  const int r = find({"r", "red"}), g = find({"g", "green"}), b = find({"b", "blue"});
  const int y = find({"y", "i", "l", "gray", "grey", "luminance"});
  const bool chroma = find({"ry"}) >= 0 || find({"by"}) >= 0;
  std::vector<int> others;
  for (int c = 0; c < spec.nchannels; ++c)
    if (c != picked.alpha) others.push_back(c);
  if (r >= 0 && g >= 0 && b >= 0) {
    picked.colour = {r, g, b};
  } else if (y >= 0 && !chroma) {
    picked.colour = {y};
  } else if (others.size() == 1 || (others.size() == 3 && !chroma)) {
    picked.colour = others;
  } else {
    throw Error("'" + path + "' holds the channels " + join(spec.channelnames), {},
                "an image has R, G and B or a single channel, and optionally A");
  }
  return picked;
}

/// Position of the upright image's pixel (x, y) in the file's image, for the eight orientations of Exif.
/// `width` and `height` are the file's.
std::pair<int, int> filePosition(int orientation, int x, int y, int width, int height) {
  switch (orientation) {
    case 2:
      return {width - 1 - x, y};
    case 3:
      return {width - 1 - x, height - 1 - y};
    case 4:
      return {x, height - 1 - y};
    case 5:
      return {y, x};
    case 6:
      return {y, height - 1 - x};
    case 7:
      return {width - 1 - y, height - 1 - x};
    case 8:
      return {width - 1 - y, x};
    default:
      return {x, y};
  }
}

std::vector<std::string> remarksOn(const OIIO::ImageSpec& spec, bool integer) {
  std::vector<std::string> remarks;
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  const float gamma = spec.get_float_attribute("oiio:Gamma", 0.0F);
  if (integer && lower(space) == "linear") {
    remarks.push_back("the file says that its values are linear");
  } else if (integer && gamma > 0.0F && std::abs(gamma - 2.2F) > 0.05F) {
    remarks.push_back("the file states a gamma of " + shortestNumber(std::round(gamma * 1000.0) / 1000.0));
  }
  const std::string profile = spec.get_string_attribute("ICCProfile:profile_description");
  if (!profile.empty() && lower(profile).find("srgb") == std::string::npos)
    remarks.push_back("the file's colour profile '" + profile + "' is not applied");
  // Primaries and white of Rec. 709; files that state others mean other colours with the same numbers.
  constexpr float kRec709[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
  if (const OIIO::ParamValue* stated = spec.find_attribute("chromaticities")) {
    const auto* values = static_cast<const float*>(stated->data());
    bool same = stated->type().basevalues() == 8 && stated->type().basetype == OIIO::TypeDesc::FLOAT;
    for (int i = 0; same && i < 8; ++i) same = std::abs(values[i] - kRec709[i]) < 0.002F;
    if (!same) remarks.push_back("the file's primaries are not those of Rec. 709; they are not converted");
  }
  return remarks;
}

}  // namespace

ImageFile readImageFile(const std::string& path, const ImageLimits& limits) {
  OIIO::ImageSpec wish;
  // Otherwise encoded values come multiplied by alpha, which has no meaning in terms of light.
  wish.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = openChecked(path, limits, wish);
  const OIIO::ImageSpec spec = in->spec();

  ImageFile file;
  file.path = path;
  file.format = in->format_name();
  file.integer = !spec.format.is_floating_point();
  file.bits = spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(8 * spec.format.size()));
  file.premultiplied = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0;
  file.remarks = remarksOn(spec, file.integer);
  const Channels channels = pickChannels(spec, path);
  const Image raw = readPixels(*in, spec, path);
  const int further = spec.get_int_attribute("oiio:subimages", 0);
  if (further > 1 || in->seek_subimage(1, 0))
    file.remarks.push_back("the file holds several pictures; the first one is used");
  const size_t taken = channels.colour.size() + (channels.alpha >= 0 ? 1 : 0);
  if (taken < static_cast<size_t>(spec.nchannels))
    file.remarks.push_back("of the channels " + join(spec.channelnames) + " only the picture's are used");

  // Files without a display window show everything they hold.
  const bool window = spec.full_width > 0 && spec.full_height > 0;
  const int fullWidth = window ? spec.full_width : spec.width;
  const int fullHeight = window ? spec.full_height : spec.height;
  const int left = window ? spec.full_x - spec.x : 0, top = window ? spec.full_y - spec.y : 0;
  const int orientation = std::clamp(spec.get_int_attribute("Orientation", 1), 1, 8);
  const bool turned = orientation >= 5;
  const int colours = static_cast<int>(channels.colour.size());
  file.image = Image(turned ? fullHeight : fullWidth, turned ? fullWidth : fullHeight, colours);
  if (channels.alpha >= 0) file.alpha = Image(file.image.width, file.image.height, 1);
  for (int y = 0; y < file.image.height; ++y)
    for (int x = 0; x < file.image.width; ++x) {
      auto [fromX, fromY] = filePosition(orientation, x, y, fullWidth, fullHeight);
      fromX += left;  // windows lie within half the range of an int, see checked_input.cpp
      fromY += top;
      if (fromX < 0 || fromY < 0 || fromX >= raw.width || fromY >= raw.height) continue;
      for (int c = 0; c < colours; ++c)
        file.image.at(x, y, c) = raw.at(fromX, fromY, channels.colour[static_cast<size_t>(c)]);
      if (channels.alpha >= 0) file.alpha.at(x, y) = raw.at(fromX, fromY, channels.alpha);
    }
  return file;
}

}  // namespace limen::codec
