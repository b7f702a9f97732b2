// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Visibility techniques that others build on: which one, and those of its parameters that decide how its
/// shadows move, as the techniques themselves declare them. What is not among them keeps its default.
class WrappedTechnique {
 public:
  /// `inner`, resolution, budget, structure, fixed_level, occluders, bias, slope_bias and rays.
  static std::vector<Parameter> parameters();
  /// Throws Error where a value is about another technique than the inner one, or the inner one refuses it.
  static void check(const ParameterValues& values);
  static std::unique_ptr<Technique> make(const ParameterValues& values);
  /// What count() of any of them may return that counterNames() holds.
  static std::vector<Counter> count(Technique& technique, frame::Frame& frame);
  static std::vector<std::string> counterNames();
};

}  // namespace limen::techniques
