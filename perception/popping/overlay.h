// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "experiments/base/image.h"
#include "perception/popping/regions.h"

namespace limen::perception {

struct OverlayOptions {
  double opacity = 0.65;  ///< of a region's colour over the grey context
  bool outlines = true;   ///< dark pixels around each region, so that small ones can be spotted
  bool legend = true;     ///< a scale of R below the image, if it is wide enough
};

/// Colour of a rating, sRGB in [0, 1]: blue up to R = 0, green at 1 (below: rarely visible), yellow at 2,
/// orange at 3 (above: easily detected), dark red from 4 on. Lightness falls from yellow to either side.
std::array<double, 3> ratingColour(double rating);

/// Popping regions in context (Schwarz 2009, Fig. 10.5): the picture in grey, each region in the colour of
/// its rating. `context` is display-coded, 1 or 3 or more channels, of the map's size. The result has 3
/// channels and the same width; a legend adds legendHeightPx(width) rows. Throws Error on another size.
Image poppingOverlay(const Image& context, const RegionMap& regions, const OverlayOptions& options = {});
/// 0 if there is no room for one.
int legendHeightPx(int width);

}  // namespace limen::perception
