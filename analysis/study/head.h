// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/output/result.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// What the answers are and what was left out of them: opens every result. Tables "rules" and "left_out".
Section headOf(const StudyAnswers& study);
/// A row for each rule that the protocol declares, and what it took away.
ResultTable ruleTable(const StudyAnswers& study);
ResultTable leftOutTable(const StudyAnswers& study);

}  // namespace limen::analysis
