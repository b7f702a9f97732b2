// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "analysis/study/answers.h"
#include "experiments/store/predictions.h"

namespace limen::analysis {

/// Where levels of coverage and rating begin. The thesis names the levels and prints neither their edges nor
/// how many regions it averages (Schwarz 2009, section 10.4.2): these are choices.
struct ScoreBins {
  std::array<double, 3> coverage{0.01, 0.05, 0.20};  ///< from which on small, large, huge
  std::array<double, 3> rating{1.0, 2.0, 3.0};       ///< from which on low, high, very high
  size_t topRegions = 3;                             ///< most highly rated regions, whose mean R is the score
};
/// limen::Error, naming the option, unless edges grow, coverage lies in 0 .. 1 and there is a region.
void checkScoreBins(const ScoreBins& bins);

/// 1 tiny, 2 small, 3 large, 4 huge.
int coverageLevel(double coverage, const ScoreBins& bins = {});
/// 1 very low, 2 low, 3 high, 4 very high.
int ratingLevel(double rating, const ScoreBins& bins = {});
/// Table 10.1 of the thesis: 1 .. 5 by rating level and coverage level.
int detectionScore(int ratingLevel, int coverageLevel);
/// Mean of the `top` largest ratings, of all if there are fewer; `without` if there is none.
double ratingScore(std::vector<double> ratings, double without, size_t top);

/// A figure that is compared with answers; larger means more visible.
struct PredictorName {
  std::string name, meaning;
};
const std::vector<PredictorName>& studyPredictors();

/// Values of studyPredictors() from the figures of a stored prediction; what it lacks is missing. ssim is
/// turned around as 1 - ssim.
std::map<std::string, double> predictorValues(const nlohmann::json& figures, const ScoreBins& bins = {});

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
  int version = 1;  ///< of the predictor's figures; 1: ratings are of all regions, whatever was cued
  std::map<PredictionKey, std::map<std::string, double>> values;  ///< of predictorValues()
};

/// Names of displays by hash: those of the answers and those that were predicted for.
std::map<std::string, std::string> displayNames(const std::string& store, const StudyAnswers& study,
                                                const std::vector<store::StudyPrediction>& predictions);

/// The display that a prediction must be for, given the one that was used. `names` has the known displays by
/// hash. Throws Error if the one asked for is none of them, or several.
std::string wantedDisplay(const std::string& used, const std::map<std::string, std::string>& names,
                          const PredictionChoice& choice);

/// Throws Error if one that is wanted is missing, or no prediction has the settings asked for.
ChosenPredictions choosePredictions(const std::vector<store::StudyPrediction>& predictions,
                                    const StudyPlan& plan, const std::set<PredictionKey>& wanted,
                                    const PredictionChoice& choice);

}  // namespace limen::analysis
