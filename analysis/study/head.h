// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/study/answers.h"

namespace limen::analysis {

/// What the answers are and what was left out of them: opens every result.
std::string headText(const StudyAnswers& study);
nlohmann::json headJson(const StudyAnswers& study);

}  // namespace limen::analysis
