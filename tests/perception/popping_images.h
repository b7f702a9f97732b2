// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "perception/popping/predictor.h"

/// Inputs for tests of the popping predictor.
namespace limen::perception {

/// 1024 x 768 window of the study's display: 41.2 pixels per degree.
inline DisplayProfile studyDisplay() { return displayPreset("schwarz_2009"); }

inline Image noiseImage(int width, int height, int channels, unsigned seed, double low = 0.0,
                        double high = 1.0) {
  std::mt19937 random(seed);
  Image image(width, height, channels);
  for (float& value : image.data)
    value = static_cast<float>(low + (high - low) * static_cast<double>(random() >> 8) * 0x1p-24);
  return image;
}

/// Shaded ground, a disc at (discX, 0.5), a sharp line: linear RGB.
inline Image sceneImage(int width, int height, double discX) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width, v = (y + 0.5) / height;
      const bool disc = std::hypot((u - discX) * width / height, v - 0.5) < 0.25;
      const bool line = std::abs(u - v) * width < 1.0;
      const double shade[3] = {0.4 + 0.3 * std::sin(9.0 * u), 0.3 + 0.2 * std::cos(7.0 * v + u),
                               0.2 + 0.5 * u * v};
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = static_cast<float>(line   ? 0.95
                                               : disc ? 0.15 * (c + 1) + 0.05 * shade[c]
                                                      : shade[c]);
    }
  return image;
}

inline PoppingInput linearPair(Image actual, Image predicted) {
  PoppingInput input;
  input.actual = std::move(actual);
  input.predicted = std::move(predicted);
  input.linear = true;
  return input;
}

inline Image uniformImage(int width, int height, int channels, float value) {
  return Image(width, height, channels, value);
}

}  // namespace limen::perception
