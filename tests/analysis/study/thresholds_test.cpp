// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of observers: answers that leave one solution, a posterior by hand, and how often intervals hold
// the truth where observers differ.
#include "analysis/study/thresholds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "analysis/study/analyses.h"
#include "perception/psychometrics/random.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;

StudyAnswers studyOf(const std::string& protocol, size_t observers) {
  StudyAnswers out;
  out.plan = readStudyPlan({"hash", "p", "p.yaml", "By hand", protocol}, "s.sqlite");
  for (size_t i = 0; i < observers; ++i) out.observers.push_back("p" + std::to_string(i));
  return out;
}

void answer(StudyAnswers& study, size_t observer, const std::map<std::string, std::string>& condition,
            double x, int yes, int count, bool change = true) {
  for (int i = 0; i < count; ++i) {
    StudyAnswer one;
    one.observer = observer;
    one.session = static_cast<int64_t>(observer) + 1;
    one.condition = condition;
    one.axes = {x};
    one.change = change;
    one.outcome = i < yes ? 1 : 0;
    study.answers.push_back(one);
  }
}

const char* const kTwoKinds =
    "task: {type: yes_no}\n"
    "factors:\n  kind: [fine, coarse]\n"
    "titles: {size: size of the gap}\n"
    "procedure: {type: psi, stimulus: {name: size, from: 0, to: 50, count: 51, unit: px}, stop: {trials: "
    "40}}\n";

/// F(t - 1) = 1/4, F(t + 1) = 3/4, F(1000) = 1, and 20 trials without a change: the logistic function with
/// threshold t and width 2 ln 19 / ln 3 meets all of them.
void answersWithThreshold(StudyAnswers& study, size_t observer, const std::string& kind, double t) {
  answer(study, observer, {{"kind", kind}}, t - 1.0, 10, 40);
  answer(study, observer, {{"kind", kind}}, t + 1.0, 30, 40);
  answer(study, observer, {{"kind", kind}}, 1000.0, 20, 20);
  answer(study, observer, {{"kind", kind}}, 0.0, 0, 20, false);
}

TEST(Thresholds, OfObserversAndTheirPairedTest) {
  StudyAnswers study = studyOf(kTwoKinds, 4);
  study.plan.parts[0].procedure = nullptr;  // answers alone
  const double fine[] = {10.0, 12.0, 15.0, 11.0}, coarse[] = {7.0, 10.0, 11.0, 10.0};
  for (size_t i = 0; i < 4; ++i) {
    answersWithThreshold(study, i, "fine", fine[i]);
    answersWithThreshold(study, i, "coarse", coarse[i]);
  }
  const PartThresholds part = studyThresholds(study).at(0);
  EXPECT_EQ(part.title, "size of the gap (px)");
  ASSERT_EQ(part.observers.size(), 8U);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(*part.observers[2 * i].value, fine[i], 1e-3);
    EXPECT_NEAR(*part.observers[2 * i + 1].value, coarse[i], 1e-3);
    EXPECT_EQ(part.observers[2 * i].trials, 120);
  }
  // fine: mean 12, sd sqrt(14 / 3); t of 3 degrees of freedom is 3.182446.
  EXPECT_NEAR(*part.conditions[0].mean, 12.0, 1e-3);
  EXPECT_NEAR(*part.conditions[0].sd, std::sqrt(14.0 / 3.0), 2e-3);
  EXPECT_NEAR(part.conditions[0].interval->high, 12.0 + 3.182446 * std::sqrt(14.0 / 12.0), 5e-3);
  // Differences 3, 2, 4, 1: mean 2.5, sd sqrt(5 / 3), t = 2.5 / sqrt(5 / 12) with 3 degrees of freedom.
  const double t = 2.5 / std::sqrt(5.0 / 12.0);
  ASSERT_TRUE(part.anova && part.anova->result);
  const PairedComparison& pair = part.anova->comparisons.at(0).pairs.at(0);
  EXPECT_NEAR(pair.difference, 2.5, 2e-3);
  EXPECT_NEAR(pair.t, t, 5e-3);
  EXPECT_NEAR(*part.anova->result->effects.at(0).f, t * t, 0.04);
  // Of two conditions the interval within observers has sqrt(2) sd of the difference / 2 for its sd: half the
  // difference is what is left of each observer, times c / (c - 1) = 2 in variance.
  const double half = 3.182446 * std::sqrt(5.0 / 3.0) / 2.0 * std::sqrt(2.0) / 2.0;
  EXPECT_NEAR(part.conditions[0].within->high - 12.0, half, 5e-3);
}

TEST(Thresholds, ThatAnswersDoNotSetAreNoneAndNamed) {
  StudyAnswers study = studyOf(kTwoKinds, 3);
  study.plan.parts[0].procedure = nullptr;
  for (size_t i = 0; i < 3; ++i) {
    answersWithThreshold(study, i, "fine", 10.0 + static_cast<double>(i));
    if (i < 2) answersWithThreshold(study, i, "coarse", 8.0);
  }
  // Never seen, however large.
  for (const double x : {5.0, 10.0, 40.0}) answer(study, 2, {{"kind", "coarse"}}, x, 0, 20);
  const PartThresholds part = studyThresholds(study).at(0);
  const ObserverThreshold& none = part.observers.back();
  EXPECT_FALSE(none.value);
  EXPECT_THAT(none.note, HasSubstr("bound"));
  EXPECT_EQ(part.conditions[1].observers, 2U);
  EXPECT_EQ(part.anova->incomplete, std::vector<std::string>{"p2"});
  const Section section = sectionOf(part, study);
  EXPECT_THAT(section.notes, testing::Contains(HasSubstr("left out of the tests: p2")));
}

// Two thresholds of equal prior, slope 2: a right answer at 1 has the probability 1 - e^-1 / 2 if the
// threshold is 1 and 1 - e^-(1/4) / 2 if it is 2; a wrong one at 2 has e^-4 / 2 and e^-1 / 2.
TEST(Thresholds, PosteriorOfQuestPlusIsThatByHand) {
  StudyAnswers study = studyOf(
      "task: {type: interval}\n"
      "procedure:\n  type: quest_plus\n  model: weibull\n  stimulus: {name: x, values: [1, 2]}\n"
      "  parameters: {threshold: [1, 2], slope: 2, guess: 0.5, lapse: 0}\n  stop: {trials: 9}\n",
      1);
  answer(study, 0, {}, 1.0, 1, 1);
  answer(study, 0, {}, 2.0, 0, 1);
  std::vector<const StudyAnswer*> answers;
  for (const StudyAnswer& one : study.answers) answers.push_back(&one);
  const auto estimate = procedureEstimate(study, 0, answers);
  ASSERT_TRUE(estimate);
  const double one = (1.0 - std::exp(-1.0) / 2.0) * std::exp(-4.0) / 2.0,
               two = (1.0 - std::exp(-0.25) / 2.0) * std::exp(-1.0) / 2.0;
  EXPECT_NEAR(estimate->value, (one + 2.0 * two) / (one + two), 1e-12);
  EXPECT_EQ(estimate->target, "F = 0.632");
  EXPECT_THAT(estimate->kind, HasSubstr("credible"));
  ASSERT_TRUE(study.plan.parts[0].assumed);
  EXPECT_EQ(study.plan.parts[0].assumed->sigmoid, "weibull");
  EXPECT_NEAR(study.plan.parts[0].assumed->level, 1.0 - std::exp(-1.0), 1e-12);
}

/// 8 observers with thresholds from a normal distribution around 5, alike in all else; 10 trials at each of 7
/// levels and 20 without a change. The mixture is symmetric, so that 5 is the threshold of pooled answers,
/// too.
StudyAnswers drawStudy(uint64_t seed) {
  StudyAnswers study = studyOf(
      "task: {type: yes_no}\nfactors:\n  x: [1, 3, 4, 5, 6, 7, 9]\n"
      "simulation: {variable: x, sigmoid: logistic}\n",
      8);
  psychometrics::Random random(seed);
  constexpr double kGuess = 0.05, kLapse = 0.02, kWidth = 3.0;
  for (size_t observer = 0; observer < study.observers.size(); ++observer) {
    const double threshold = random.normal(5.0, 1.0);
    for (const StudyFactor& factor : study.plan.parts[0].factors)
      for (const std::string& level : factor.levels) {
        const double f =
            1.0 / (1.0 + std::exp(-2.0 * std::log(19.0) * (std::stod(level) - threshold) / kWidth));
        answer(study, observer, {{"x", level}}, 0.0,
               random.binomial(10, kGuess + (1.0 - kGuess - kLapse) * f), 10);
      }
    answer(study, observer, {{"x", "5"}}, 0.0, random.binomial(20, kGuess), 20, false);
  }
  return study;
}

struct Coverage {
  int held = 0, given = 0;
  void count(const std::optional<Interval>& interval) {
    if (!interval) return;
    ++given;
    held += interval->low <= 5.0 && 5.0 <= interval->high ? 1 : 0;
  }
  double share() const { return static_cast<double>(held) / given; }
};

// (Of 1000 studies the intervals hold it in 958, those of means in 956, profile intervals in 497.) Of 200
// studies 95 % are 190 with a standard deviation of 3.1: three of those are 90.4 to 99.6 %. Profile intervals
// of the pooled answers, which take 560 answers of 8 observers as independent, hold it far more rarely.
TEST(Thresholds, IntervalsOverObserversHoldTheTruthAsOftenAsTheySay) {
  const TemporaryFolder folder;
  FitOptions typed;
  typed.file = folder.path("data");
  std::ofstream(typed.file) << "x\n";
  Coverage pooled, profile, means;
  const int studies = 200;
  for (uint64_t seed = 1; seed <= static_cast<uint64_t>(studies); ++seed) {
    const StudyAnswers study = drawStudy(seed);
    const FittedPart part = fittedParts(study, {}).at(0);
    const size_t threshold = indexOf(FitParameter::Threshold);
    const FitAnswer fit = fitPart(study, part, typed);
    ASSERT_EQ(fit.intervals->method, IntervalMethod::Observers);
    pooled.count(fit.intervals->conditions[0][threshold]);
    profile.count(profileIntervals(part.conditions, fit.fit, 0.95).conditions[0][threshold]);
    means.count(studyThresholds(study).at(0).conditions.at(0).interval);
  }
  EXPECT_EQ(pooled.given, studies);
  EXPECT_EQ(means.given, studies);
  for (const Coverage& one : {pooled, means}) {
    EXPECT_GT(one.share(), 0.904);
    EXPECT_LT(one.share(), 0.996);
  }
  EXPECT_LT(profile.share(), 0.85);
  RecordProperty("pooled", pooled.held);
  RecordProperty("means", means.held);
  RecordProperty("profile", profile.held);
}

}  // namespace
}  // namespace limen::analysis
