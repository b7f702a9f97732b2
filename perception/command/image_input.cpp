// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/image_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "perception/command/video_inputs.h"

namespace limen::perception {
namespace {

const char* curveName(const DisplayProfile& display) {
  switch (display.transfer) {
    case TransferCurve::Srgb:
      return "sRGB";
    case TransferCurve::Gamma:
      return "gamma";
    case TransferCurve::Linear:
      return "linear";
  }
  return "";
}

std::string describeAssumption(const std::string& values, const DisplayProfile& display) {
  if (values == "linear") return "linear light, 1 is the display's white";
  if (values == "luminance") return "absolute light in cd/m2, clipped to what the display shows";
  std::string curve = curveName(display);
  if (display.transfer == TransferCurve::Gamma) curve += fmt::format(" {:g}", display.gamma);
  return "display-coded, " + curve + " curve";
}

void toColour(Image& image) {
  if (image.data.empty() || image.channels != 1) return;
  Image colour(image.width, image.height, 3);
  for (size_t pixel = 0; pixel < image.pixels(); ++pixel)
    std::fill_n(colour.data.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, image.data[pixel]);
  image = std::move(colour);
}

/// Multiplies the image by alpha unless it is premultiplied.
void overBlack(Image& image, const Image& alpha) {
  for (size_t pixel = 0; pixel < image.pixels(); ++pixel)
    for (int c = 0; c < image.channels; ++c)
      image.data[pixel * static_cast<size_t>(image.channels) + static_cast<size_t>(c)] *= alpha.data[pixel];
}

std::string countText(int64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// Counts what the display cannot show and adds warnings.
void checkRange(InputImage& input) {
  const auto channels = static_cast<size_t>(input.linear.channels);
  int64_t above = 0, below = 0;
  for (size_t pixel = 0; pixel < input.linear.pixels(); ++pixel) {
    bool over = false, under = false;
    for (size_t c = 0; c < channels; ++c) {
      const float value = input.linear.data[pixel * channels + c];
      if (!std::isfinite(value)) ++input.nonFinite;
      over = over || value > 1.0F;
      under = under || value < 0.0F;
    }
    above += over;
    below += under;
    input.clippedPx += over || under;
  }
  if (input.nonFinite > 0)
    input.warnings.push_back(
        countText(input.nonFinite, "value is", "values are") +
        " infinite or not a number; shown as white if plus infinite, otherwise as black");
  const auto share = [&](int64_t count) {
    return fmt::format("{} ({:.3g} %)", countText(count, "pixel", "pixels"),
                       100.0 * static_cast<double>(count) / static_cast<double>(input.linear.pixels()));
  };
  if (above > 0)
    input.warnings.push_back(share(above) + " brighter than the display's white, shown clipped to it");
  if (below > 0)
    input.warnings.push_back(share(below) + " darker than the display's black, shown clipped to it");
}

}  // namespace

const SettingsTable<InputSettings>& InputSettings::table() {
  static const SettingsTable<InputSettings> kTable = {
      {&InputSettings::values, "values",
       "what files contain. coded: pixel values, converted to light by the display's curve; linear: light, 1 "
       "is the "
       "display's "
       "white; luminance: light in cd/m2; auto: integers are coded, floating-point numbers linear"},
      {&InputSettings::alpha, "alpha",
       "over_black: composited over black in linear light; ignore: colours as in the file"}};
  return kTable;
}

const std::vector<Parameter>& inputParameters() {
  static const std::vector<Parameter> kParameters = InputSettings::table().parameters();
  return kParameters;
}

Image InputImage::shown() const {
  Image image(linear.width, linear.height, 3);
  const auto channels = static_cast<size_t>(linear.channels);
  for (size_t pixel = 0; pixel < linear.pixels(); ++pixel)
    for (size_t c = 0; c < 3; ++c) {
      const float value = linear.data[pixel * channels + (channels == 1 ? 0 : c)];
      image.data[3 * pixel + c] = value > 0.0F ? std::min(value, 1.0F) : 0.0F;  // NaN fails the comparison
    }
  return image;
}

nlohmann::json InputImage::toJson() const {
  nlohmann::json out = {{"path", path},
                        {"sha256", sha256},
                        {"width_px", width()},
                        {"height_px", height()},
                        {"channels", linear.channels},
                        {"kind", kind},
                        {"assumed", assumed},
                        {"non_finite", nonFinite},
                        {"clipped_px", clippedPx}};
  if (!alpha.empty()) out["alpha"] = alpha;
  if (videoFrame) out["video_frame"] = *videoFrame + 1;
  return out;
}

std::string InputImage::line() const {
  return fmt::format("{}: {}, {} x {} {}, {}{}", path, kind, width(), height(),
                     linear.channels == 1 ? "grey" : "RGB", assumed, alpha.empty() ? "" : "; " + alpha);
}

namespace {

/// What the file's numbers mean on this display. `out` has path and kind.
InputImage interpret(ImageFile file, InputImage out, const DisplayProfile& display,
                     const ParameterValues& input) {
  const std::string& path = out.path;
  out.warnings = file.remarks;
  const InputSettings settings = InputSettings::table().read(input);
  const std::string values = settings.values != FileValues::Auto ? toText(settings.values)
                             : file.integer                      ? "coded"
                                                                 : "linear";
  if (values == "luminance" && file.integer)
    throw Error("'" + path + "' holds integers, which cannot be cd/m2", "--scene-luminance",
                "give EXR, HDR or floating-point TIFF");
  out.assumed = describeAssumption(values, display);
  out.coded = values == "coded";

  Image& light = out.linear = std::move(file.image);
  if (out.coded) {
    out.values = light;
    for (float& value : light.data)
      value =
          std::isfinite(value) ? static_cast<float>(display.decode(std::clamp(value, 0.0F, 1.0F))) : value;
  } else if (values == "luminance") {
    // The screen adds its black level to everything it shows.
    const double black = display.blackLevelCdM2(), span = display.whiteLevelCdM2() - black;
    for (float& value : light.data) value = static_cast<float>((double{value} - black) / span);
  }
  if (!file.alpha.data.empty()) {
    const bool opaque =
        std::all_of(file.alpha.data.begin(), file.alpha.data.end(), [](float a) { return a == 1.0F; });
    if (opaque) {
      out.alpha = "alpha is 1 everywhere";
    } else if (settings.alpha == AlphaHandling::Ignore) {
      out.alpha =
          file.premultiplied ? "alpha ignored, colours are premultiplied in the file" : "alpha ignored";
    } else {
      out.alpha = "composited over black";
      if (!file.premultiplied) {
        overBlack(light, file.alpha);
        out.values = {};  // the file does not contain what a display would be sent for half-covered pixels
      }
    }
  }
  checkRange(out);
  if (out.width() > display.resolutionPx.x || out.height() > display.resolutionPx.y)
    out.warnings.push_back(
        fmt::format("{} x {} pixels do not fit the display's {} x {}; evaluated at its pixel pitch",
                    out.width(), out.height(), display.resolutionPx.x, display.resolutionPx.y));
  if (values == "luminance")
    for (float& value : light.data)
      if (std::isfinite(value)) value = std::clamp(value, 0.0F, 1.0F);
  return out;
}

}  // namespace

InputImage readInput(const std::string& path, const DisplayProfile& display, const ParameterValues& input) {
  ImageFile file = readImageFile(path);
  InputImage out;
  out.path = path;
  out.kind = file.kind();
  out.sha256 = sha256File(path);
  return interpret(std::move(file), std::move(out), display, input);
}

InputImage readInput(const FrameSet& frame, size_t argument, const DisplayProfile& display,
                     const ParameterValues& input) {
  const std::string& path = frame.paths[argument];
  const std::optional<int64_t>& index = frame.videoFrames[argument];
  if (!index) return readInput(path, display, input);
  VideoReader& video = videoInput(path);
  ImageFile file;
  file.image = video.frame(*index);
  file.path = path;
  file.integer = true;
  file.bits = 8;
  if (*index == 0) file.remarks = video.facts().remarks;
  InputImage out;
  out.path = path;
  out.kind = video.facts().kind() + ", " + video.facts().colour;
  out.sha256 = videoSha256(path);
  out.videoFrame = index;
  return interpret(std::move(file), std::move(out), display, input);
}

void matchInputs(InputImage& first, InputImage& second) {
  if (first.width() != second.width() || first.height() != second.height())
    throw Error(fmt::format("'{}' is {} x {}, '{}' is {} x {}", first.path, first.width(), first.height(),
                            second.path, second.width(), second.height()),
                {}, "give images of the same size");
  if (first.linear.channels == second.linear.channels) return;
  for (InputImage* input : {&first, &second}) {
    toColour(input->linear);
    toColour(input->values);
  }
}

Image readMap(const std::string& path, const std::string& option, int channels, const InputImage& like) {
  Image map;
  try {
    map = readImage(path);
  } catch (const Error& error) {
    throw Error(error.message(), option, error.hint());
  }
  if (map.width != like.width() || map.height != like.height())
    throw Error(fmt::format("'{}' is {} x {}, the images are {} x {}", path, map.width, map.height,
                            like.width(), like.height()),
                option, "give a map of the images' size");
  if (map.channels < channels)
    throw Error(fmt::format("'{}' has {} channel{}", path, map.channels, map.channels == 1 ? "" : "s"),
                option, fmt::format("it takes {}", channels));
  return map;
}

}  // namespace limen::perception
