// SPDX-License-Identifier: BSD-3-Clause
// Blocks of a study's answers, counted by hand, and the lapse rates that they tell.
#include "analysis/study/fitted_parts.h"

#include <gmock/gmock.h>

#include <cmath>

#include "analysis/study/lapse_rule.h"
#include "tests/analysis/statistics/expect.h"
#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kFittedProtocol =
    "task: {type: yes_no}\n"
    "factors:\n"
    "  kind: [fine, coarse]\n"
    "  distance: [4, 8.5]\n"
    "simulation: {variable: distance, direction: falling, axis: log, sigmoid: gumbel, level: 0.6}\n";

class FittedPartsTest : public testing::Test {
 protected:
  std::string store() const { return folder_.path("s.sqlite"); }
  StudyAnswers read() const {
    StudyChoice choice;
    choice.codes = true;
    choice.store = store();
    return readStudyAnswers(choice);
  }
  TemporaryFolder folder_;
};

std::vector<HandMadeTrial> at(const std::string& kind, const std::string& distance, int yes, int count,
                              bool change = true) {
  return trials({{"kind", kind}, {"distance", distance}}, yes, count, change);
}

struct Counted {
  double level;
  int64_t correct, trials;
};
void expectBlocks(const Condition& condition, const std::vector<Counted>& expected) {
  ASSERT_EQ(condition.blocks.size(), expected.size()) << condition.name;
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(condition.blocks[i].level, expected[i].level) << condition.name;
    EXPECT_EQ(condition.blocks[i].correct, expected[i].correct) << condition.name;
    EXPECT_EQ(condition.blocks[i].trials, expected[i].trials) << condition.name;
  }
}

TEST_F(FittedPartsTest, BlocksOfAFactorByHand) {
  addHandMadeSession(store(), "a", kFittedProtocol,
                     at("coarse", "8.5", 1, 3) + at("fine", "4", 2, 2) + at("fine", "4", 1, 1, false));
  addHandMadeSession(store(), "b", kFittedProtocol,
                     at("fine", "4", 1, 2) + at("fine", "8.5", 0, 2) + at("fine", "8.5", 0, 3, false));
  const StudyAnswers study = read();
  const std::vector<FittedPart> parts = fittedParts(study, {});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].variable, "distance");
  EXPECT_EQ(parts[0].task.kind, FitTask::Kind::YesNo);
  ASSERT_EQ(parts[0].conditions.size(), 2U);
  EXPECT_EQ(parts[0].conditions[0].name, "kind=fine");
  expectBlocks(parts[0].conditions[0], {{kNoStimulus, 1, 4}, {4.0, 3, 4}, {8.5, 0, 2}});
  expectBlocks(parts[0].conditions[1], {{8.5, 1, 3}});
  EXPECT_THAT(parts[0].notes, Contains(HasSubstr("2 observers pooled")));
  // Fourth and fifth trial of a, first and second of b, all from 0.
  EXPECT_DOUBLE_EQ(parts[0].conditions[0].blocks[1].order, (3 + 4 + 0 + 1) / 4.0);

  FittedPartsChoice choice;
  choice.by = std::vector<std::string>{"observer"};
  const FittedPart each = fittedParts(study, choice)[0];
  ASSERT_EQ(each.conditions.size(), 2U);
  EXPECT_EQ(each.conditions[0].name, "observer=a");
  expectBlocks(each.conditions[0], {{kNoStimulus, 1, 1}, {4.0, 2, 2}, {8.5, 1, 3}});
  expectBlocks(each.conditions[1], {{kNoStimulus, 0, 3}, {4.0, 1, 2}, {8.5, 0, 2}});
  EXPECT_THAT(each.notes, Contains("pooled over kind"));

  choice.by.emplace();
  choice.guessFromCatch = true;
  const FittedPart pooled = fittedParts(study, choice)[0];
  ASSERT_EQ(pooled.conditions.size(), 1U);
  expectBlocks(pooled.conditions[0], {{4.0, 3, 4}, {8.5, 1, 5}});
  EXPECT_EQ(pooled.guess, 0.25);
}

// 1 - F of a rising Gumbel is the reversed one of the mirrored axis.
TEST_F(FittedPartsTest, TakesTheAssumedFunctionFromTheProtocol) {
  addHandMadeSession(store(), "a", kFittedProtocol, at("fine", "4", 1, 2));
  const StudyAnswers study = read();
  const std::optional<AssumedFunction>& assumed = study.plan.parts[0].assumed;
  ASSERT_TRUE(assumed);
  EXPECT_EQ(assumed->variable, "distance");
  EXPECT_EQ(assumed->direction, "falling");
  EXPECT_EQ(assumed->axis, "log");
  EXPECT_EQ(assumed->sigmoid, "reversed_gumbel");
  EXPECT_EQ(assumed->level, 0.6);
}

TEST_F(FittedPartsTest, BlocksOfAProcedureByHand) {
  const std::string protocol =
      "parts:\n"
      "  - name: pairs\n"
      "    task: {type: pairwise}\n"
      "  - name: main\n"
      "    task: {type: interval, alternatives: 4}\n"
      "    factors: {size: [1, 2]}\n"
      "    procedure: {type: quest_plus, stimulus: [{name: near}, {name: fast}]}\n"
      "simulation:\n"
      "  variable: fast\n"
      "  parts: {main: {variable: near, sigmoid: weibull}}\n";
  std::vector<HandMadeTrial> own = trials({{"size", "1"}}, 2, 4) + trials({{"size", "2"}}, 1, 2);
  for (size_t i = 0; i < own.size(); ++i) own[i].axes = {i % 2 ? 0.5 : 0.25, 7.0 + static_cast<double>(i)};
  addHandMadeSession(store(), "a", protocol, own);
  const StudyAnswers study = read();
  const std::vector<FittedPart> parts = fittedParts(study, {});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].variable, "near");
  EXPECT_EQ(nameOf(parts[0].task), "mafc:4");
  ASSERT_EQ(parts[0].conditions.size(), 2U);
  expectBlocks(parts[0].conditions[0], {{0.25, 1, 2}, {0.5, 1, 2}});
  expectBlocks(parts[0].conditions[1], {{0.25, 1, 1}, {0.5, 0, 1}});
  EXPECT_THAT(parts[0].notes, Contains("pooled over fast"));
  EXPECT_THAT(parts[0].notes, Contains(HasSubstr("not fitted: part pairs")));
  EXPECT_EQ(study.plan.parts[1].assumed->axis, "log");

  FittedPartsChoice choice;
  choice.variable = "size";
  choice.by.emplace();
  expectBlocks(fittedParts(study, choice)[0].conditions[0], {{1.0, 2, 4}, {2.0, 1, 2}});
}

TEST_F(FittedPartsTest, SaysWhatThereIsToChooseFrom) {
  const std::string protocol =
      "task: {type: yes_no}\nfactors:\n  kind: [fine, coarse]\n  distance: [4, 8]\n  speed: [1, 2]\n";
  addHandMadeSession(store(), "a", protocol,
                     trials({{"kind", "fine"}, {"distance", "4"}, {"speed", "1"}}, 1, 2));
  const StudyAnswers study = read();
  const auto fail = [&](const FittedPartsChoice& choice, const std::string& words) {
    expectError([&] { fittedParts(study, choice); }, words);
  };
  fail({}, "distance, speed");
  fail({"", "kind", {}, false}, "levels of 'kind' are no numbers");
  fail({"", "size", {}, false}, "--x takes distance, speed");
  fail({"mein", "", {}, false}, "did you mean 'main'");
  fail({"", "speed", std::vector<std::string>{"distanc"}, false}, "did you mean 'distance'");
  fail({"", "speed", std::vector<std::string>{"speed"}, false}, "is what is fitted");
  fail({"", "speed", {}, true}, "no catch trials");
  addHandMadeSession(store(), "b", "task: {type: rating}\nfactors: {distance: [1, 2]}\n",
                     trials({{"distance", "1"}}, 1, 3));
  StudyChoice rating;
  rating.store = store();
  rating.protocol = "task: {type: rating}\nfactors: {distance: [1, 2]}\n";
  expectError([&] { fittedParts(readStudyAnswers(rating), {}); }, "rating");
}

constexpr const char* kLapsing =
    "task: {type: interval, alternatives: 2}\n"
    "factors:\n"
    "  contrast: [1, 2, 3, 4]\n"
    "exclusions: {lapse_above: 0.1}\n";

/// Half right at 1, three quarters at 2, and of `easy` trials each at 3 and 4 all but `misses`.
std::vector<HandMadeTrial> observer(int easy, int misses) {
  const auto own = [](const char* contrast, int right, int count) {
    return trials({{"contrast", contrast}}, right, count);
  };
  return own("1", 20, 40) + own("2", 30, 40) + own("3", easy - misses, easy) + own("4", easy - misses, easy);
}

/// Twice ln of the likelihood of k misses in n at rate k/n over that at the limit.
double ratioOf(int k, int n, double limit) {
  const double rate = static_cast<double>(k) / n;
  return 2.0 *
         ((k > 0 ? k * std::log(rate / limit) : 0.0) + (n - k) * std::log((1.0 - rate) / (1.0 - limit)));
}

// Contrasts 3 and 4 lie far above the threshold, which is near 2: where F is 1 the likelihood is largest at
// the share of misses. The other parameters can make up for a wrong rate, so that the ratio is at most that
// of the misses.
TEST_F(FittedPartsTest, LapseRateIsTheShareOfMissesWhereAllIsSeen) {
  addHandMadeSession(store(), "never", kLapsing, observer(40, 0));
  addHandMadeSession(store(), "seldom", kLapsing, observer(40, 1));
  addHandMadeSession(store(), "often", kLapsing, observer(40, 9));
  addHandMadeSession(store(), "short", kLapsing, observer(3, 1));
  StudyChoice choice;
  choice.codes = true;
  choice.store = store();
  choice.exclusions = false;
  const std::vector<ObserverLapse> rates = lapseRates(readStudyAnswers(choice), 0.1).observers;
  ASSERT_EQ(rates.size(), 4U);
  EXPECT_NEAR(rates[0].rate.value(), 0.0, 1e-6);
  EXPECT_NEAR(rates[1].rate.value(), 0.025, 0.002);
  EXPECT_NEAR(rates[2].rate.value(), 0.225, 0.005);
  EXPECT_EQ(rates[0].verdict, ObserverLapse::Verdict::Below);
  EXPECT_EQ(rates[1].verdict, ObserverLapse::Verdict::Below);
  EXPECT_EQ(rates[2].verdict, ObserverLapse::Verdict::Above);
  EXPECT_EQ(rates[3].verdict, ObserverLapse::Verdict::Untold);
  const int misses[] = {0, 2, 18, 2}, trials[] = {80, 80, 80, 6};
  for (size_t i = 0; i < 4; ++i)
    EXPECT_LE(rates[i].statistic, ratioOf(misses[i], trials[i], 0.1) + 1e-6) << i;
  // With nobody to make up for it: no misses at P = 0.9 each.
  EXPECT_NEAR(rates[0].statistic, ratioOf(0, 80, 0.1), 0.05 * ratioOf(0, 80, 0.1));

  const StudyAnswers left = read();
  EXPECT_THAT(left.observers, ElementsAre("never", "seldom", "short"));
  ASSERT_EQ(left.rules.size(), 1U);
  EXPECT_TRUE(left.rules[0].applied);
  EXPECT_THAT(left.rules[0].note, HasSubstr("1 of 4 observers"));
  EXPECT_THAT(left.rules[0].note, HasSubstr("short"));
  ASSERT_EQ(left.leftOut.size(), 1U);
  EXPECT_EQ(left.leftOut[0].observer, "often");
  EXPECT_THAT(left.leftOut[0].detail, HasSubstr("lapse rate 0.22"));
}

TEST_F(FittedPartsTest, LapseRuleSaysWhenNothingTellsIt) {
  addHandMadeSession(store(), "short", kLapsing, observer(3, 1));
  const StudyAnswers study = read();
  ASSERT_EQ(study.rules.size(), 1U);
  EXPECT_FALSE(study.rules[0].applied);
  EXPECT_THAT(study.rules[0].note, HasSubstr("1 of 1 observers"));
  EXPECT_THAT(study.observers, ElementsAre("short"));
}

}  // namespace
}  // namespace limen::analysis
