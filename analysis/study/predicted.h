// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "analysis/study/plan.h"
#include "analysis/study/scores.h"
#include "experiments/store/predictions.h"

namespace limen::analysis {

/// Which predictions of a store are meant.
struct PredictionChoice {
  ScoreBins bins;
  std::string display;   ///< name or hash of the predictions' display; "": the sessions'
  std::string settings;  ///< first digits of the SHA-256 of the predictor's settings; "": newest
};

/// Hashes of stimulus and display.
using PredictionKey = std::pair<std::string, std::string>;

/// Predictions of one program with one set of settings: figures of different ones are not comparable.
struct ChosenPredictions {
  std::string settingsHash, programVersion;
  std::map<PredictionKey, std::map<std::string, double>> values;  ///< of predictorValues()
};

/// The display that a prediction must be for, given the one that was used. `names` has the known displays by
/// hash. Throws Error if the one asked for is none of them, or several.
std::string wantedDisplay(const std::string& used, const std::map<std::string, std::string>& names,
                          const PredictionChoice& choice);

/// Throws Error if one that is wanted is missing, or no prediction has the settings asked for.
ChosenPredictions choosePredictions(const std::vector<store::StudyPrediction>& predictions,
                                    const StudyPlan& plan, const std::set<PredictionKey>& wanted,
                                    const PredictionChoice& choice);

}  // namespace limen::analysis
