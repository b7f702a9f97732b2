// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "study/observers/observer.h"
#include "study/procedures/procedure.h"

namespace limen::study {

/// The stimulus that a procedure estimates, for one observer in one condition; nothing if that is undefined
/// (several dimensions, a model without a threshold, a probability that is never reached) or would need the
/// popping predictor. `trial`: any of the procedure's, with a change. `estimate`: of the procedure, for the
/// probability that a staircase tends to.
std::optional<double> trueThreshold(SimulatedObserver& observer, const Trial& trial,
                                    const ProcedureSettings& settings, const Estimate& estimate);

}  // namespace limen::study
