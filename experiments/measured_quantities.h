// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/store/store.h"

namespace limen::experiments {

/// What a run may have whatever its technique and metrics are: times, memory, the GPU's clock, the scales of
/// its pictures.
const std::vector<store::QuantityRow>& commonQuantities();

bool isCommonQuantity(const std::string& name);

/// One of them, measured: unit and kind are those of its declaration.
store::Measurement measured(const std::string& name, std::optional<double> value);

}  // namespace limen::experiments
