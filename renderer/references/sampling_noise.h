// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "experiments/base/parameter.h"
#include "experiments/base/registry.h"

namespace limen::references {

/// Noise of a reference whose pixels are sampled independently of each other, registered beside it. A
/// reference that samples all pixels at the same points has none: its errors go together and do not average
/// out.
struct SamplingNoise {
  static constexpr const char* kKind = "sampling noise";
  std::string name;  ///< of the reference
  /// Largest possible standard deviation of one pixel's value.
  std::function<double(const ParameterValues&)> deviation;
};
using SamplingNoiseRegistry = Registry<SamplingNoise>;

}  // namespace limen::references
