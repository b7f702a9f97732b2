// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/answer_fits/fit_answer.h"
#include "analysis/answer_fits/fit_options.h"
#include "analysis/study/fitted_parts.h"

namespace limen::analysis {

/// Fits a part as its protocol's `simulation:` block describes it, where `typed` does not say otherwise: its
/// task, sigmoid, axis, direction and threshold level. Throws Error as answerFit().
FitAnswer fitPart(const StudyAnswers& study, const FittedPart& part, const FitOptions& typed);

/// Of a part with a numeric variable: its functions, or why there are none.
struct PartFit {
  std::string part;
  std::optional<FitAnswer> answer;
  std::string note;
};

/// Every part with right and wrong or yes and no answers and a numeric variable, as `limen analyse fit` fits
/// it unless told otherwise, with 95 % profile intervals. `store`: the file that the answers are from.
std::vector<PartFit> studyFits(const StudyAnswers& study, const std::string& store);

}  // namespace limen::analysis
