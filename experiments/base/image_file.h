// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/image.h"

namespace limen {

/// A picture as its file holds it, with what the file says about the meaning of its values. Pixels are where
/// an image viewer shows them: orientation (Exif) is applied, and an EXR's data window is placed in its
/// display window (black around it, cropped to it).
struct ImageFile {
  Image image;  ///< 1 (grey) or 3 (RGB) channels; integers scaled to [0, 1]
  Image alpha;  ///< 1 channel, or empty where the file has none
  std::string path;
  std::string format;    ///< OpenImageIO's name: "png", "jpeg", "tiff", "openexr", "hdr", ...
  bool integer = false;  ///< stored as integers; otherwise as floating-point numbers
  int bits = 0;          ///< of a stored value
  /// Colours are premultiplied by alpha (all floating-point formats, some TIFF files).
  bool premultiplied = false;
  /// What the file states that a plain sRGB or linear reading ignores, as text for a warning: its own gamma
  /// or colour space, further pictures or channels.
  std::vector<std::string> remarks;

  /// "8-bit png", "32-bit float openexr"
  std::string kind() const;
};

/// Reads the first picture of any format that OpenImageIO knows. Takes the channels R, G, B (or the only one,
/// or Y) and A. Throws Error: no such file, not an image, incomplete, channels that do not form a picture.
ImageFile readImageFile(const std::string& path);

}  // namespace limen
