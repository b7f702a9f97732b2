// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/catalogue.h"
#include "experiments/descriptor.h"
#include "experiments/store/descriptions.h"

namespace limen::experiments {

/// What the names in the runs of a descriptor mean: the quantities that they may measure (common ones, its
/// metrics, its techniques' counters) and the parameters that its entries declare.
store::Descriptions describeNames(const Descriptor& descriptor, const Catalogue& catalogue);

}  // namespace limen::experiments
