// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/study/plan.h"
#include "analysis/study/predicted.h"

namespace limen::analysis {

/// Anybody's scores of the clips of a study: a table with one row per clip, named in column `clip` (as limen
/// study export --clips does) or by its stimulus in column `stimulus_hash`. Every other column is a
/// predictor.
struct ClipScores {
  std::string file, hash;          ///< SHA-256 of the file
  std::vector<std::string> names;  ///< of the predictors
  bool byClip = true;              ///< false: by stimulus
  /// By clip or stimulus. Larger is more visible: scores of quality have their signs turned.
  std::map<std::string, std::map<std::string, double>> values;
};

/// `quality` names the predictors of which larger is better. Throws Error: an unreadable table, neither or
/// both of the columns, no score, a score that is no number, a clip or name twice, a name that Limen's own
/// predictors have, a name in `quality` that is no column.
ClipScores readClipScores(const std::string& file, const std::vector<std::string>& quality);

/// Adds the scores to the predictors of the stimuli that are wanted. Returns how many rows of the table are
/// of others. Throws Error if a stimulus has no score.
size_t addClipScores(const ClipScores& scores, const StudyPlan& plan,
                     std::map<PredictionKey, std::map<std::string, double>>& values);

}  // namespace limen::analysis
