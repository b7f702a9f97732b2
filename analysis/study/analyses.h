// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/answer_fits/fit_answer.h"
#include "analysis/answer_fits/fit_options.h"
#include "analysis/observer_statistics/anova.h"
#include "analysis/observer_statistics/mixed.h"
#include "analysis/observer_statistics/sensitivity.h"
#include "analysis/output/result.h"
#include "analysis/pair_scales/pair_table.h"
#include "analysis/pair_scales/scale.h"
#include "analysis/study/answers.h"
#include "analysis/study/fitted_parts.h"
#include "analysis/study/published.h"

namespace limen::analysis {

/// What the answers are and what was left out of them: opens every result. Tables "rules" and "left_out".
Section headOf(const StudyAnswers& study);
/// A row for each rule that the protocol declares, and what it took away.
ResultTable ruleTable(const StudyAnswers& study);
ResultTable leftOutTable(const StudyAnswers& study);

/// Analysis of variance of all parts with answers: each observer's rate of reports (or of right answers) in
/// each condition, of trials with a change. Schwarz 2009, sections 10.4.1 and 10.4.2: each effect against its
/// own interaction with observers. Factors of one level are left out. The published values are those of the
/// protocols experiment_1 and experiment_2; they are of rates that were not transformed.
std::vector<PartAnova> studyAnova(const StudyAnswers& study, const AnovaSettings& settings = {});

/// d' and criterion of all parts with answers. Pooled over observers d' comes out too small where they
/// differ: the mean over observers is the one to report. limen::Error without correction where a rate is 0
/// or 1.
std::vector<PartSensitivity> studySensitivity(const StudyAnswers& study,
                                              RateCorrection correction = RateCorrection::kLogLinear);

/// Answers of one part to trials with a change, one a row, by observer, with the part's factors as columns.
/// `part` may be "" if only one part has answers. Throws Error for an unknown part, one whose answers are not
/// one of two, and one whose stimuli a procedure chose.
MixedRows studyMixedRows(const StudyAnswers& study, const std::string& part);

/// Judgements of the parts that compare items in pairs; a group for each part and, within it, each level of
/// the factors `by`, in the protocol's order. Subjects are the observers, rounds the passes through all pairs
/// in one order under one condition. Throws Error: no such part, or a factor that a part does not have (with
/// the nearest).
std::vector<PairGroup> readStudyPairs(const StudyAnswers& study, const std::vector<std::string>& by);

/// Of a part that compares items in pairs: their scale, or why there is none.
struct PartScale {
  std::string part;
  ScaleSetting setting;
  std::optional<ItemScale> scale;
  std::string note;
};

/// Every part that compares items in pairs, as `limen analyse scale` scales it unless told otherwise; parts
/// without a judgement are left out.
std::vector<PartScale> studyScales(const StudyAnswers& study);

/// Fits a part as its protocol's `simulation:` block describes it, where `typed` does not say otherwise: its
/// task, sigmoid, axis, direction and threshold level. Intervals, unless named, are those over observers
/// where several are pooled, else profile intervals. Throws Error as answerFit().
FitAnswer fitPart(const StudyAnswers& study, const FittedPart& part, const FitOptions& typed);

/// Of a part with a numeric variable: its functions, or why there are none.
struct PartFit {
  std::string part;
  std::optional<FitAnswer> answer;
  std::string note;
};

/// Every part with right and wrong or yes and no answers and a numeric variable, as `limen analyse fit` fits
/// it unless told otherwise. `store`: the file that the answers are from.
std::vector<PartFit> studyFits(const StudyAnswers& study, const std::string& store);

}  // namespace limen::analysis
