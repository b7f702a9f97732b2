// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "perception/popping/predictor.h"

/// How both the predictor and the comparator read PoppingInput.
namespace limen::perception {

/// Throws Error if sizes differ or channels are missing, naming the image.
void checkPoppingInput(const PoppingInput& input);

/// Values of a pixel as they are, grey as three equal ones; non-finite values count as 0.
std::array<double, 3> pixelValues(const Image& image, int x, int y);

/// Relative light of a pixel, >= 0.
std::array<double, 3> pixelLight(const PoppingInput& input, const Image& image, const DisplayProfile& display,
                                 int x, int y);

}  // namespace limen::perception
