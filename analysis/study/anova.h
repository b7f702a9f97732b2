// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/observer_statistics/anova.h"
#include "analysis/study/answers.h"
#include "analysis/study/published.h"

namespace limen::analysis {

/// Analysis of variance of all parts with answers: each observer's rate of reports (or of right answers) in
/// each condition, of trials with a change. Schwarz 2009, sections 10.4.1 and 10.4.2: each effect against its
/// own interaction with observers. Factors of one level are left out. The published values are those of the
/// protocols experiment_1 and experiment_2; they are of rates that were not transformed.
std::vector<PartAnova> studyAnova(const StudyAnswers& study, const AnovaSettings& settings = {});

}  // namespace limen::analysis
