// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/observer_statistics/mixed.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// Answers of one part to trials with a change, one a row, by observer, with the part's factors as columns.
/// `part` may be "" if only one part has answers. Throws Error for an unknown part, one whose answers are not
/// one of two, and one whose stimuli a procedure chose.
MixedRows studyMixedRows(const StudyAnswers& study, const std::string& part);

}  // namespace limen::analysis
