// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/base/image.h"

namespace limen::perception {

/// Round scale for a picture of a map: one that at most one pixel in a hundred exceeds, so that a few do not
/// darken all others; for a map that is 0 nearly everywhere, one that none exceeds.
double pictureScale(const Image& map);

/// Writes the map in colours, with the scale and `description` in the file. Returns what the colours mean:
/// "black 0, pale yellow 20 JND and above". Throws Error.
std::string writeMapPicture(const std::string& path, const Image& map, double scale, const std::string& unit,
                            const std::string& description);

}  // namespace limen::perception
