// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/output/result.h"
#include "analysis/statistics/rank_correlation.h"
#include "analysis/statistics/roc.h"
#include "analysis/study/answers.h"
#include "analysis/study/link.h"
#include "analysis/study/predicted.h"
#include "analysis/study/published.h"
#include "analysis/study/scores.h"
#include "experiments/store/predictions.h"

namespace limen::analysis {

/// One stimulus with a change on one display: what was predicted and what was answered.
struct Scenario {
  std::string condition, presentation, stimulusHash, displayHash;
  int64_t yes = 0, trials = 0;
  ObserverCounts observers;            ///< the same for each
  double rate = 0.0;                   ///< mean over observers of their own rates
  std::optional<double> meanSeverity;  ///< of those who said yes and were asked
  std::map<std::string, double> predictors;
};

/// How a predictor goes with the detection rates of a set of scenarios.
struct Agreement {
  std::string set, predictor;  ///< set: "static", "dynamic", "both", or "all" if stimuli are of one kind
  size_t scenarios = 0;
  Kendall kendall;
  std::optional<Correlation> pearson;  ///< none if predictor or rates do not vary
  ClampedPearson clamped;
  std::optional<PublishedAgreement> published;
};

/// Single trials with a change: does the predictor tell those noticed from those not?
struct TrialArea {
  std::string predictor;
  RocArea area;
  std::optional<RocComparison> againstRating;  ///< this predictor minus `rating`; none for that itself
};

/// Two predictors on the same trials.
struct TrialComparison {
  std::string first, second;
  RocComparison areas;  ///< first minus second
};

struct PartValidation {
  std::string part;
  std::vector<std::string> predictors;  ///< Limen's own, then those of ClipScores
  std::vector<Scenario> scenarios;
  std::vector<Agreement> agreements;
  std::vector<Agreement> severity;  ///< rating_score and its level with mean severity; no clamp
  std::vector<TrialArea> areas;     ///< empty if all trials were answered alike
  /// Rating, FLIP, SSIM, ColorVideoVDP and ClipScores, each with each.
  std::vector<TrialComparison> comparisons;
  std::optional<Calibration> calibration;
  LinkReport link;
  std::vector<std::string> notes;
};

struct ValidationSetting : PredictionChoice {
  std::optional<ClipScores> scores;  ///< to compare with the predictors, or instead of them if there are none
  std::optional<double> guess;       ///< of the link; none: from catch trials
  bool fitGuess = false;             ///< fitted together with the catch trials
  std::optional<double> lapse;       ///< none: fitted
  size_t samples = 400;              ///< of the bootstrap over observers, for the link
  uint64_t seed = 1;
  bool onlyAgreements = false;  ///< no areas, calibration and link
};

struct StudyValidation {
  std::string settingsHash, programVersion;  ///< of the predictions; "" without any
  std::string scoresFile, scoresHash;        ///< of ClipScores; "" without them
  std::vector<std::string> displays;         ///< that were predicted for
  std::vector<PartValidation> parts;         ///< those that ask for yes or no
  std::vector<std::string> notes;
};

/// Compares answers with predictions, part by part. Schwarz 2009, section 10.4. Rates are means over
/// observers; trials of one observer are taken as independent where single trials count (areas, calibration),
/// so that intervals there are too narrow. Those of the link are over observers.
///
/// Throws Error if a stimulus has no prediction, or if the display or the settings asked for are unknown.
StudyValidation validateStudy(const StudyAnswers& study,
                              const std::vector<store::StudyPrediction>& predictions,
                              const std::map<std::string, std::string>& displayNames,
                              const ValidationSetting& setting = {});

/// A section for each part with tables "scenarios" (rates and predictors of each), "agreement", "areas",
/// "comparisons", "calibration", "bins", "link" and "link_errors".
Result resultOf(const StudyValidation& validation);

}  // namespace limen::analysis
