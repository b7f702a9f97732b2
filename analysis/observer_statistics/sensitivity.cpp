// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/observer_statistics/sensitivity.h"

#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

void analyseRow(SensitivityRow& row, const PartSensitivity& part) {
  if (row.trials == 0) return;
  try {
    if (!part.yesNo)
      row.mAfc = analyseMAfc(row.correct, row.trials, part.alternatives, part.correction);
    else if (row.counts.signalTrials > 0 && row.counts.noiseTrials > 0)
      row.yesNo = analyseYesNo(row.counts, part.correction);
  } catch (const Error& error) {
    throw Error(error.message(),
                (row.observer.empty() ? "all together" : "'" + row.observer + "'") + ", " + error.where(),
                error.hint());
  }
}

}  // namespace

void analyseSensitivity(PartSensitivity& part) {
  std::vector<double> dPrimes, criteria, lnBetas, aPrimes;
  for (SensitivityRow& row : part.rows) {
    analyseRow(row, part);
    if (row.observer.empty()) continue;
    if (row.mAfc) dPrimes.push_back(row.mAfc->dPrime);
    if (!row.yesNo) continue;
    dPrimes.push_back(row.yesNo->dPrime);
    criteria.push_back(row.yesNo->criterion);
    lnBetas.push_back(row.yesNo->lnBeta);
    aPrimes.push_back(row.yesNo->aPrime);
  }
  const auto mean = [](const std::vector<double>& values) {
    return values.empty() ? std::nullopt : std::optional(meanOverSubjects(values));
  };
  part.dPrime = mean(dPrimes);
  part.criterion = mean(criteria);
  part.lnBeta = mean(lnBetas);
  part.aPrime = mean(aPrimes);
}

}  // namespace limen::analysis
