// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/output/result.h"
#include "analysis/study/analyses.h"
#include "analysis/study/rates.h"
#include "analysis/study/validation.h"

namespace limen::analysis {

/// One number that was printed, and the same of one's own answers.
struct ComparedValue {
  std::string quantity;           ///< "mean", "sd", "F", "df", "df error", "p", "tau_c", "r", ...
  std::string published;          ///< as printed: "67.71 %", "< 0.0001"
  std::optional<double> printed;  ///< as a number, rates as shares; none for a bound
  std::optional<double> ours;     ///< none if the answers do not tell
  std::string oursText;
};

/// A statistic that was printed, with all its numbers.
struct ComparedStatistic {
  std::string part;  ///< "" for the whole study
  std::string statistic;
  std::vector<ComparedValue> values;
  std::string note;  ///< why ours is missing, or what to mind
  std::string source;
};

/// All that the thesis printed of one experiment, beside the answers of one store.
struct PublishedComparison {
  std::string protocol;
  size_t observers = 0;
  bool simulated = false;
  std::string data;  ///< "people", or the kinds of simulated observer: "simulated: model"
  std::vector<ComparedStatistic> statistics;
  std::vector<std::string> notes;
};

/// What was found by the analyses of one store's answers.
struct StudyFindings {
  const StudyAnswers* study = nullptr;
  const StudyRates* rates = nullptr;
  const std::vector<PartAnova>* anova = nullptr;
  const StudyValidation* validation = nullptr;  ///< may be missing
  ScoreBins bins;                               ///< of the validation
  std::string whyNotValidated;                  ///< if it is missing
  std::vector<std::string> observerKinds;       ///< of simulated observers
};

/// Every statistic of the study's protocol that stands in published.h, in the order of the thesis. None of
/// them is worked out here: they come from the findings. A note, and no statistic, for a protocol of which
/// nothing was published.
PublishedComparison comparePublished(const StudyFindings& findings);

/// A section for each experiment with a table "statistics", one row a number.
Result resultOf(const std::vector<PublishedComparison>& comparisons);

}  // namespace limen::analysis
