// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/interval.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// The threshold that an adaptive procedure arrived at.
struct ProcedureEstimate {
  double value = 0.0;                ///< mean of the posterior, or of the reversals
  std::optional<Interval> interval;  ///< at 95 %
  std::string kind;                  ///< of the interval
  std::string target;                ///< what the threshold is of: "F = 0.632", "P = 0.707"
};

/// Runs the procedure of a part again on an observer's answers to one condition, as they were given; of
/// several sessions one after the other. None of parts without a procedure, procedures without one axis and
/// one threshold (interleaved ones among them), and staircases that were run twice, or from which an answer
/// was left out, whose reversals are lost.
std::optional<ProcedureEstimate> procedureEstimate(const StudyAnswers& study, size_t part,
                                                   const std::vector<const StudyAnswer*>& answers);

}  // namespace limen::analysis
