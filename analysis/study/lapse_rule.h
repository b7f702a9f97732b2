// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/study/answers.h"

namespace limen::analysis {

/// What an observer's answers say of the lapse rate beside a limit.
struct ObserverLapse {
  enum class Verdict { Untold, Below, Above };
  Verdict verdict = Verdict::Untold;
  std::optional<double> rate;  ///< that fits best; none without a fit
  double statistic = 0.0;      ///< twice by how much the log-likelihood falls where the rate is the limit
};

struct LapseRates {
  std::vector<ObserverLapse> observers;
  std::string why;  ///< why no part was fitted; empty if one was
};

/// Of each observer the lapse rate that fits best (maximum likelihood) to the observer's own answers to a
/// part: conditions are the factors beside the stimulus variable, with thresholds of their own and one width,
/// one lapse rate and, in yes/no tasks, one guess rate, catch trials included; sigmoid, axis and direction as
/// the protocol's `simulation:` block has them.
///
/// A lapse shows only where the stimulus is seen. Elsewhere, and with few trials, a steep function with many
/// lapses and a shallow one without fit nearly as well: of 40 simulated observers who never lapse, with 160
/// trials of QUEST+ each, five and more had a fitted rate above 0.1. So the verdict is not the estimate's:
/// the rate is above, or below, the limit only where the limit fits worse by the 95 % quantile of a one-sided
/// likelihood ratio (statistic above 2.706).
///
/// Of several parts one that says "above" is enough; else one that says "below".
LapseRates lapseRates(const StudyAnswers& study, double limit);

}  // namespace limen::analysis
