// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/base/image.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

/// Absolute or relative error, or change, shown as white in pictures: the same in all runs, so that pictures
/// can be compared.
inline constexpr double kErrorScale = 0.25;

/// Difference shown as white in pictures of a JND map, the same in all runs.
inline constexpr double kJndPictureWhite = 10.0;

/// A product as a viewable picture, display-coded, 3 channels. `shading`: see ViewImages.
Image productPicture(techniques::ProductKind kind, const Image& product, const Image& shading);

/// Value shown as white in pictures of a metric's map (MetricResult::mapName), the same in all runs.
double mapWhite(const std::string& mapName);

/// Images as seen by a person have no mask: the background also adapts the eye.
bool evaluatedEverywhere(techniques::ProductKind kind);

/// SHA-256 over the exact values and the size: equal for equal products.
std::string productHash(const Image& product);

}  // namespace limen::experiments
