// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/observer_statistics/sensitivity.h"

#include <fmt/format.h>

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

/// Columns of an estimate of yes/no answers and of its interval.
void addEstimate(TableOf<SensitivityRow>& table, const std::string& name, const std::string& title,
                 double YesNoSensitivity::*value, Interval YesNoSensitivity::*bounds) {
  table.add(number(name, title), at(&SensitivityRow::yesNo, value))
      .add(interval(name), at(&SensitivityRow::yesNo, bounds));
}

ResultTable rowTable(const PartSensitivity& part) {
  TableOf out("rows", "", part.rows);
  out.add(forData(text("observer")), [](const SensitivityRow& row) {
    return row.observer.empty() ? ResultCell() : ResultCell(row.observer);
  });
  out.add(forPeople(text("", part.subjects ? "observer" : "rows")),
          [](const SensitivityRow& row) { return row.observer.empty() ? "all together" : row.observer; });
  if (!part.yesNo) {
    return out.add(count("correct", "trials"), countOf(&SensitivityRow::correct, &SensitivityRow::trials))
        .add(forPeople(share("", "share")),
             [](const SensitivityRow& row) {
               return static_cast<double>(row.correct) / static_cast<double>(row.trials);
             })
        .add(forData(number("proportion_correct")),
             at(&SensitivityRow::mAfc, &MAfcSensitivity::proportionCorrect))
        .add(number("d_prime", "d′"), at(&SensitivityRow::mAfc, &MAfcSensitivity::dPrime))
        .add(interval("d_prime"), [](const SensitivityRow& row) {
          return row.mAfc ? ResultCell(Interval{row.mAfc->low.value_or(-INFINITY),
                                                row.mAfc->high.value_or(INFINITY)})
                          : ResultCell();
        });
  }
  out.add(count("hits", "signal_trials"), [](const SensitivityRow& row) {
    return CountOf{row.counts.hits, row.counts.signalTrials};
  });
  out.add(count("false_alarms", "noise_trials"), [](const SensitivityRow& row) {
    return CountOf{row.counts.falseAlarms, row.counts.noiseTrials};
  });
  for (const auto& [name, member] : {std::pair{"hit_rate", &YesNoSensitivity::hitRate},
                                     std::pair{"false_alarm_rate", &YesNoSensitivity::falseAlarmRate}})
    out.add(forData(number(name)), at(&SensitivityRow::yesNo, member));
  addEstimate(out, "d_prime", "d′", &YesNoSensitivity::dPrime, &YesNoSensitivity::dPrimeInterval);
  addEstimate(out, "criterion", "c", &YesNoSensitivity::criterion, &YesNoSensitivity::criterionInterval);
  addEstimate(out, "ln_beta", "ln β", &YesNoSensitivity::lnBeta, &YesNoSensitivity::lnBetaInterval);
  addEstimate(out, "beta", "β", &YesNoSensitivity::beta, &YesNoSensitivity::betaInterval);
  addEstimate(out, "a_prime", "A′", &YesNoSensitivity::aPrime, &YesNoSensitivity::aPrimeInterval);
  return out;
}

struct NamedMean {
  const char *name, *title;
  MeanOverSubjects mean;
};

ResultTable meanTable(const PartSensitivity& part) {
  std::vector<NamedMean> rows;
  const auto add = [&](const char* name, const char* title, const std::optional<MeanOverSubjects>& mean) {
    if (mean) rows.push_back({name, title, *mean});
  };
  add("d_prime", "sensitivity d′", part.dPrime);
  add("criterion", "criterion c", part.criterion);
  add("ln_beta", "ln β", part.lnBeta);
  add("a_prime", "A′", part.aPrime);
  const auto of = [](auto member) { return at(&NamedMean::mean, member); };
  return TableOf("means", part.subjects ? "means over observers" : "means over rows", rows)
      .add(forData(text("parameter")), &NamedMean::name)
      .add(forPeople(text("", "mean of")), &NamedMean::title)
      .add(integer("observers", part.subjects ? "observers" : "rows"), of(&MeanOverSubjects::subjects))
      .add(number("estimate", "mean"), of(&MeanOverSubjects::mean))
      .add(interval(), of(&MeanOverSubjects::interval))
      .add(number("sd"), of(&MeanOverSubjects::standardDeviation));
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

Section sectionOf(const PartSensitivity& part) {
  Section out;
  out.title = part.title;
  out.fact(key(text("part")), part.part.empty() ? ResultCell() : ResultCell(part.part));
  out.fact(forData(flag("yes_no")), part.yesNo);
  out.fact(forData(integer("alternatives")), part.alternatives);
  out.fact(forData(text("correction")), toText(part.correction));
  out.add(rowTable(part));
  out.add(meanTable(part));
  if (!part.rows.empty()) {
    std::string method = part.yesNo ? "yes/no, equal-variance Gaussian model; c above 0: reluctant to say yes"
                                    : fmt::format("{} alternatives, unbiased observer", part.alternatives);
    method += "; rates ";
    method += part.correction == RateCorrection::kLogLinear ? "k of n as (k + 1/2) / (n + 1)" : "as they are";
    out.notes.push_back(method);
    // GCC 12 misreads the length of a literal that becomes a string here (GCC bug 105329).
    static const std::string kPooled =
        "all together: answers pooled; d′ comes out too small where rows differ, report the mean";
    if (part.rows.size() > 1) out.notes.push_back(kPooled);
  }
  if (!part.note.empty()) out.notes.push_back(part.note);
  return out;
}

Result resultOf(const std::vector<PartSensitivity>& parts) {
  Result out;
  out.command = "sdt";
  for (const PartSensitivity& part : parts) out.sections.push_back(sectionOf(part));
  return out;
}

}  // namespace limen::analysis
