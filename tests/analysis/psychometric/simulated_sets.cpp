// SPDX-License-Identifier: BSD-3-Clause
#include "tests/analysis/psychometric/simulated_sets.h"

#include "perception/psychometrics/psychometric_function.h"
#include "perception/psychometrics/random.h"

namespace limen::analysis {

using psychometrics::PsychometricFunction;
using psychometrics::Sigmoid;

Condition classicSet() {
  const double levels[] = {.0010, .0015, .0020, .0025, .0030, .0035, .0040,
                           .0045, .0050, .0060, .0070, .0080, .0100};
  const int correct[] = {45, 50, 44, 44, 52, 53, 62, 64, 76, 79, 88, 90, 90};
  Condition condition;
  for (size_t i = 0; i < 13; ++i)
    condition.blocks.push_back({levels[i], correct[i], 90, static_cast<double>(i)});
  return condition;
}

CoverageExperiment coverageExperiment(const std::string& task) {
  CoverageExperiment experiment;
  experiment.settings.task = readFitTask(task, "task");
  const bool yesNo = experiment.settings.task.kind == FitTask::Kind::YesNo;
  experiment.truth = {0.0, 2.0, yesNo ? 0.05 : 1.0 / experiment.settings.task.alternatives, 0.02, 0.0};
  const Sigmoid sigmoid =
      Sigmoid::fromThresholdWidth(experiment.settings.sigmoid, experiment.settings.axis, 0.0, 2.0);
  for (const double f : {0.1, 0.3, 0.5, 0.8, 0.98}) experiment.levels.push_back(sigmoid.inverse(f));
  return experiment;
}

Condition drawSet(const CoverageExperiment& experiment, int index) {
  const Sigmoid sigmoid =
      Sigmoid::fromThresholdWidth(experiment.settings.sigmoid, experiment.settings.axis, experiment.truth[0],
                                  experiment.truth[1], experiment.settings.thresholdLevel);
  const PsychometricFunction observer(sigmoid, experiment.truth[2], experiment.truth[3]);
  psychometrics::Random random(psychometrics::childSeed(7, "set " + std::to_string(index)));
  Condition condition;
  for (const double level : experiment.levels) {
    const int trials = static_cast<int>(experiment.trials);
    condition.blocks.push_back({level, random.binomial(trials, observer.probability(level)), trials,
                                static_cast<double>(condition.blocks.size())});
  }
  return condition;
}

std::vector<CoverageCount> countCoverage(const CoverageExperiment& experiment,
                                         const std::vector<std::string>& methods, int first, int sets,
                                         size_t samples) {
  std::vector<CoverageCount> counts(methods.size());
  std::array<double, kFitQuantities> truth{};
  std::copy(experiment.truth.begin(), experiment.truth.end(), truth.begin());
  truth[kFitParameters] = Sigmoid::fromThresholdWidth(experiment.settings.sigmoid, experiment.settings.axis,
                                                      truth[0], truth[1], experiment.settings.thresholdLevel)
                              .slopeAtThreshold(experiment.settings.thresholdLevel);
  for (int index = first; index < first + sets; ++index) {
    const std::vector<Condition> conditions = {drawSet(experiment, index)};
    const Fit fit = fitPsychometric(conditions, experiment.settings);
    std::vector<Replicate> parametric;
    const auto drawn = [&](bool fromFit) {
      return bootstrap(conditions, fit, {samples, static_cast<uint64_t>(index), fromFit, 1});
    };
    for (size_t m = 0; m < methods.size(); ++m) {
      FitIntervals intervals;
      if (methods[m] == "profile") {
        intervals = profileIntervals(conditions, fit, 0.95);
      } else if (methods[m] == "laplace") {
        intervals = laplaceIntervals(conditions, fit, 0.95);
      } else if (methods[m] == "posterior") {
        intervals = posteriorIntervals(conditions, fit, 0.95);
      } else if (methods[m] == "nonparametric") {
        intervals = bootstrapIntervals(conditions, fit, drawn(false), false, 0.95);
      } else {
        if (parametric.empty()) parametric = drawn(true);
        intervals = bootstrapIntervals(conditions, fit, parametric, methods[m] == "bca", 0.95);
      }
      for (size_t i = 0; i < kFitQuantities; ++i) {
        const auto& interval = intervals.conditions[0][i];
        if (!interval) continue;
        ++counts[m].given[i];
        const bool low = interval->lowOpen || interval->low <= truth[i];
        const bool high = interval->highOpen || truth[i] <= interval->high;
        if (low && high) ++counts[m].held[i];
      }
    }
  }
  return counts;
}

}  // namespace limen::analysis
