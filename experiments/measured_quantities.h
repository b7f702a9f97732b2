// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <optional>
#include <string>
#include <vector>

#include "experiments/store/store.h"

namespace limen::experiments {

/// Quantities that any run may have, whatever its technique and metrics: times, memory, the GPU's clock, the
/// scales of its pictures.
const std::vector<store::QuantityRow>& commonQuantities();

bool isCommonQuantity(const std::string& name);

/// A measurement of one of them, with its declared unit and kind.
store::Measurement measured(const std::string& name, std::optional<double> value);

/// How much independent noise of a reference's pixels, of this standard deviation, can change the difference
/// of two products' errors, each a mean over so many pixels: 95 % bound. docs/analyse.md derives it.
double noiseOfDifference(double deviation, int64_t pixels);

}  // namespace limen::experiments
