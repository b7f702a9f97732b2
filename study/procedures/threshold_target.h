// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "study/procedures/procedure.h"

namespace limen::study {

/// What a procedure's threshold is the threshold of.
struct ThresholdTarget {
  bool ofF = false;    ///< of F itself rather than the probability of outcome 1
  double value = 0.0;  ///< there
};

/// Nothing for models without one threshold. `estimate`: of the procedure, for the probability that a
/// staircase tends to.
std::optional<ThresholdTarget> thresholdTarget(const ProcedureSettings& settings, const Estimate& estimate);

/// The threshold among the parameters of an estimate ("mean" of a normal distribution); null if there is
/// none.
const ParameterEstimate* thresholdOf(const Estimate& estimate);

}  // namespace limen::study
