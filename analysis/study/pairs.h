// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/pair_scales/pair_table.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// Judgements of the parts that compare items in pairs; a group for each part and, within it, each level of
/// the factors `by`, in the protocol's order. Subjects are the observers, rounds the passes through all pairs
/// in one order under one condition. Throws Error: no such part, or a factor that a part does not have (with
/// the nearest).
std::vector<PairGroup> readStudyPairs(const StudyAnswers& study, const std::vector<std::string>& by);

}  // namespace limen::analysis
