// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include "perception/popping/predictor.h"
#include "tests/perception/popping_images.h"

/// Displays, gratings and settings that several tests of the popping predictor share.
namespace limen::perception {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// No black level, so that a grating's contrast is that of its light.
inline DisplayProfile lightlessBlack() {
  DisplayProfile display = studyDisplay();
  display.blackCdM2 = 0.0;
  return display;
}

/// Grey grating of contrast m along x on a luminance of 100 cd/m2, whole cycles in the width.
inline Image grating(int width, int height, double cyclesPerPx, double contrast, double peakCdM2) {
  Image image(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = static_cast<float>(
          100.0 / peakCdM2 * (1.0 + contrast * std::cos(2.0 * std::numbers::pi * cyclesPerPx * x)));
  return image;
}

inline Image displacementImage(int width, int height, double px) {
  Image image(width, height, 2);
  for (size_t p = 0; p < image.pixels(); ++p) image.data[2 * p] = static_cast<float>(px);
  return image;
}

inline PoppingSettings thesisSettings() { return PoppingSettings::preset(PredictorModel::Schwarz2009); }

}  // namespace limen::perception
