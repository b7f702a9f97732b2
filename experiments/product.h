// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/base/image.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

/// Absolute or relative error, or change, that pictures of errors and changes show as white: the same in all
/// runs, so that pictures can be compared.
inline constexpr double kErrorScale = 0.25;

/// Difference that pictures of a JND map show as white, in all runs alike.
inline constexpr double kJndPictureWhite = 10.0;

/// A product as a person would want to see it, display-coded, 3 channels. `shading`: see ViewImages.
Image productPicture(techniques::ProductKind kind, const Image& product, const Image& shading);

/// Value that pictures of a metric's map (MetricResult::mapName) show as white, in all runs alike.
double mapWhite(const std::string& mapName);

/// What a viewer sees has no mask: the background adapts the eye too.
bool evaluatedEverywhere(techniques::ProductKind kind);

/// SHA-256 over the exact values and the size: equal for equal products.
std::string productHash(const Image& product);

}  // namespace limen::experiments
