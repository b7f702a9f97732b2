// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "analysis/observer_statistics/sensitivity.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// d' and criterion of all parts with answers. Pooled over observers d' comes out too small where they
/// differ: the mean over observers is the one to report. limen::Error without correction where a rate is 0
/// or 1.
std::vector<PartSensitivity> studySensitivity(const StudyAnswers& study,
                                              RateCorrection correction = RateCorrection::kLogLinear);

}  // namespace limen::analysis
