// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/image.h"

namespace limen::perception {

/// Smallest of 1, 2 and 5 times a power of ten that no finite value of the map exceeds; 1 for a map without
/// errors.
double errorScale(const Image& map);

/// A 1-channel map as a viewable picture: 3 channels, ready for writePng(). Coloured in "magma", a
/// perceptually uniform colour map from black (0 and below) to pale yellow (`scale` and above). Non-finite
/// values are bright green, a colour that is not in the map. `scale` 0 means errorScale(map); state the scale
/// beside the picture, and use the same one for pictures to be compared.
Image errorPicture(const Image& map, double scale = 0.0);

/// A product as an sRGB display shows it: clamped to [0, 1] and coded, 3 channels, ready for writePng().
/// Visibility (1 channel) becomes grey, alpha is dropped, pixels with a non-finite value are bright green.
Image displayPicture(const Image& linear);

/// A map of positive values [cd/m2] as a picture: "magma" over their logarithm, from kThresholdPictureBlack
/// to kThresholdPictureWhite in every picture, so that they can be compared. Non-finite values are bright
/// green.
Image thresholdPicture(const Image& cdM2);
inline constexpr double kThresholdPictureBlack = 0.01, kThresholdPictureWhite = 100.0;

}  // namespace limen::perception
