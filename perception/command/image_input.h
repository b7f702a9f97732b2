// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/image_file.h"
#include "experiments/base/settings_table.h"
#include "perception/command/image_sequence.h"
#include "perception/vision/display.h"

namespace limen::perception {

/// What the numbers in image files mean.
enum class FileValues { Auto, Coded, Linear, Luminance };
constexpr EnumNames<FileValues, 4> enumNames(FileValues) {
  return {{{{FileValues::Auto, "auto"},
            {FileValues::Coded, "coded"},
            {FileValues::Linear, "linear"},
            {FileValues::Luminance, "luminance"}}}};
}
enum class AlphaHandling { OverBlack, Ignore };
constexpr EnumNames<AlphaHandling, 2> enumNames(AlphaHandling) {
  return {{{{AlphaHandling::OverBlack, "over_black"}, {AlphaHandling::Ignore, "ignore"}}}};
}

/// How image files are read.
struct InputSettings {
  FileValues values = FileValues::Auto;
  AlphaHandling alpha = AlphaHandling::OverBlack;
  static const SettingsTable<InputSettings>& table();
};

/// Declaration of how files are read: "values", "alpha".
const std::vector<Parameter>& inputParameters();

/// An image as stored in a file and as the display shows it.
struct InputImage {
  std::string path;
  std::string kind;                   ///< "8-bit png"
  std::string assumed;                ///< how the values were interpreted, as text
  std::string alpha;                  ///< how alpha was treated, as text; "" without alpha
  std::string sha256;                 ///< of the file
  std::optional<int64_t> videoFrame;  ///< of a video: the frame's index, from 0
  bool coded = false;                 ///< values are pixel values of a display, not light
  /// Light relative to the display's white, 1 or 3 channels, not clipped; non-finite values are kept.
  Image linear;
  /// Values of a coded file; empty for files of light, and if alpha changed the picture.
  Image values;
  int64_t nonFinite = 0;  ///< values (all channels) that are infinite or not a number
  int64_t clippedPx = 0;  ///< pixels with a channel that the display cannot show and clips
  std::vector<std::string> warnings;

  int width() const { return linear.width; }
  int height() const { return linear.height; }
  /// What the display shows: 3 channels in [0, 1]; NaN counts as 0, plus infinity as 1.
  Image shown() const;
  nlohmann::json toJson() const;
  /// "a.png: 8-bit png, 64 x 48, display-coded (sRGB curve)"
  std::string line() const;
};

/// Reads `path` for `display`. Throws Error like readImageFile().
InputImage readInput(const std::string& path, const DisplayProfile& display, const ParameterValues& input);

/// Reads the image of a frame that the argument with this index gives: a file or a frame of a video, whose
/// remarks come with its first frame. Throws Error.
InputImage readInput(const FrameSet& frame, size_t argument, const DisplayProfile& display,
                     const ParameterValues& input);

/// Throws Error unless both have the same size. Grey paired with colour becomes colour.
void matchInputs(InputImage& first, InputImage& second);

/// A map of at least `channels` channels and the size of `like` (displacement, weight). Non-finite values
/// are kept. Throws Error.
Image readMap(const std::string& path, const std::string& option, int channels, const InputImage& like);

}  // namespace limen::perception
