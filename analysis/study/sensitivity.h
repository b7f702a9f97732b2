// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/detection_rates.h"
#include "analysis/statistics/signal_detection.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// Signal detection of one observer, or of all answers together, in one part.
struct SensitivityRow {
  std::string part, observer;  ///< observer "": all answers together
  YesNoCounts counts;          ///< yes/no parts
  std::optional<YesNoSensitivity> yesNo;
  int64_t correct = 0, trials = 0;  ///< parts with several alternatives
  std::optional<MAfcSensitivity> mAfc;
};

struct PartSensitivity {
  std::string part;
  bool yesNo = true;
  int alternatives = 2;
  std::vector<SensitivityRow> rows;  ///< observers, then all answers together
  /// Means over observers; criterion of yes/no parts only.
  std::optional<MeanOverSubjects> dPrime, criterion;
  std::string note;  ///< why there is nothing, or what to mind
};

/// d' and criterion, rates corrected by k + 1/2 of n + 1 (Hautus 1995). Pooled over observers d' comes out
/// too small where they differ: the mean over observers is the one to report.
std::vector<PartSensitivity> studySensitivity(const StudyAnswers& study);

std::string toText(const std::vector<PartSensitivity>& parts);
nlohmann::json toJson(const std::vector<PartSensitivity>& parts);
std::string toCsv(const std::vector<PartSensitivity>& parts);

}  // namespace limen::analysis
