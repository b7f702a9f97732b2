// SPDX-License-Identifier: BSD-3-Clause
// What counts, what is left out, and rates that can be counted by hand.
#include "analysis/study/answers.h"

#include <gmock/gmock.h>

#include <cmath>

#include "analysis/study/analyses.h"
#include "analysis/study/rates.h"
#include "tests/analysis/statistics/expect.h"
#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::ElementsAre;

constexpr const char* kProtocol =
    "task: {type: yes_no}\n"
    "factors:\n"
    "  distance: [near, far]\n"
    "exclusions: {catch_rate_above: 0.25, reaction_time_below_s: 0.15}\n";

class StudyAnswersTest : public testing::Test {
 protected:
  std::string store() const { return folder_.path("s.sqlite"); }
  StudyAnswers read(bool exclusions = true) const {
    StudyChoice choice;
    choice.codes = true;
    choice.store = store();
    choice.exclusions = exclusions;
    return readStudyAnswers(choice);
  }
  TemporaryFolder folder_;
};

const RateRow& row(const StudyRates& rates, const std::string& text, bool change = true) {
  for (const RateRow& one : rates.rows)
    if (one.text == text && one.change == change) return one;
  throw std::runtime_error("no row " + text);
}

TEST_F(StudyAnswersTest, RatesByHand) {
  std::vector<HandMadeTrial> first = trials({{"distance", "far"}}, 0, 2) +
                                     trials({{"distance", "near"}}, 2, 2) +
                                     trials({{"distance", "near"}}, 0, 2, false);
  // None of these counts.
  HandMadeTrial practice = trials({{"distance", "near"}}, 1, 1)[0], late = practice, again = practice;
  practice.practice = true;
  late.valid = false;
  again.superseded = true;
  // What is superseded are this trial and later ones, so that it comes last.
  addHandMadeSession(store(), "a", kProtocol, first + std::vector{practice, late, again});
  addHandMadeSession(store(), "b", kProtocol,
                     trials({{"distance", "near"}}, 1, 2) + trials({{"distance", "far"}}, 1, 2) +
                         trials({{"distance", "far"}}, 1, 4, false));
  const StudyAnswers study = read();
  EXPECT_THAT(study.observers, ElementsAre("a", "b"));
  EXPECT_EQ(study.answers.size(), 14U);
  EXPECT_TRUE(study.leftOut.empty());  // b's catch rate is the limit, not above

  const StudyRates rates = studyRates(study);
  const RateRow& near = row(rates, "distance=near");
  EXPECT_EQ(near.pooled.successes, 3);
  EXPECT_EQ(near.pooled.trials, 4);
  EXPECT_DOUBLE_EQ(near.overObservers.mean, 0.75);
  EXPECT_DOUBLE_EQ(*near.overObservers.standardDeviation, std::sqrt(0.125));  // of 1 and 1/2
  const RateRow& all = row(rates, "all");
  EXPECT_DOUBLE_EQ(all.overObservers.mean, 0.5);
  EXPECT_DOUBLE_EQ(*all.overObservers.standardDeviation, 0.0);
  EXPECT_EQ(row(rates, "all", false).pooled.successes, 1);
  EXPECT_EQ(row(rates, "all", false).pooled.trials, 6);
  EXPECT_DOUBLE_EQ(row(rates, "all", false).overObservers.mean, 0.125);
  // In the protocol's order of levels, not in that of showing.
  std::vector<std::string> order;
  for (const RateRow& one : rates.rows)
    if (one.change) order.push_back(one.text);
  EXPECT_THAT(order, ElementsAre("all", "distance=near", "distance=far"));
  ASSERT_EQ(rates.observers.size(), 2U);
  EXPECT_EQ(rates.observers[1].change.successes, 2);
  EXPECT_EQ(rates.observers[1].catches->trials, 4);
}

// Somebody who says yes whenever the last frame is fine: false alarms in the catch trials that end with it.
TEST_F(StudyAnswersTest, FalseAlarmsAreToldApartByWhatCatchTrialsShowed) {
  std::vector<HandMadeTrial> before = trials({{"distance", "near"}}, 0, 4, false),
                             after = trials({{"distance", "near"}}, 3, 4, false);
  for (HandMadeTrial& trial : before) trial.catchShows = "before";
  for (HandMadeTrial& trial : after) trial.catchShows = "after";
  addHandMadeSession(store(), "a", kProtocol, trials({{"distance", "near"}}, 4, 4) + before + after);
  const StudyRates rates = studyRates(read(false));
  EXPECT_EQ(row(rates, "catch_shows=before", false).pooled.successes, 0);
  EXPECT_EQ(row(rates, "catch_shows=before", false).pooled.trials, 4);
  EXPECT_EQ(row(rates, "catch_shows=after", false).pooled.successes, 3);
  EXPECT_EQ(row(rates, "catch_shows=after", false).pooled.trials, 4);
  EXPECT_EQ(row(rates, "all", false).pooled.trials, 8);
}

TEST(PublishedRates, AreThoseOfWholeNumbersOfAnswers) {
  // 8 observers x 84 and 28 trials; 12 observers x 16 of each kind and part (Schwarz 2009, section 10.4).
  EXPECT_NEAR(publishedRate("experiment_1", "main", true)->mean, 455.0 / 672.0, 5.1e-5);
  EXPECT_NEAR(publishedRate("experiment_1", "main", false)->mean, 10.0 / 224.0, 5.1e-5);
  EXPECT_NEAR(publishedRate("experiment_2", "object", true)->mean, 118.0 / 192.0, 5.1e-5);
  EXPECT_NEAR(publishedRate("experiment_2", "object", false)->mean, 8.0 / 192.0, 5.1e-5);
  EXPECT_NEAR(publishedRate("experiment_2", "terrain", true)->mean, 130.0 / 192.0, 5.1e-5);
  EXPECT_NEAR(publishedRate("experiment_2", "terrain", false)->mean, 6.0 / 192.0, 5.1e-5);
  EXPECT_FALSE(publishedRate("quick", "main", true));
}

TEST_F(StudyAnswersTest, StaticAndDynamicComeFromStimuliWithoutAFactor) {
  std::vector<HandMadeTrial> own = trials({{"distance", "near"}}, 1, 4);
  for (size_t i = 0; i < 3; ++i) own[i].presentation = "static";
  addHandMadeSession(store(), "a", kProtocol, own);
  const StudyRates rates = studyRates(read());
  EXPECT_EQ(row(rates, "presentation=static").pooled.trials, 3);
  EXPECT_EQ(row(rates, "presentation=static").pooled.successes, 1);
  EXPECT_EQ(row(rates, "presentation=dynamic").pooled.trials, 1);
}

TEST_F(StudyAnswersTest, RulesLeaveOutByName) {
  // a: yes in 2 of 5 catch trials, above 1/4. b: the same, but one was given too quickly: 1 of 4 is left.
  const std::vector<HandMadeTrial> seen = trials({{"distance", "near"}}, 1, 2),
                                   catches = trials({{"distance", "near"}}, 2, 5, false);
  std::vector<HandMadeTrial> quick = catches;
  quick[0].reactionTimeS = 0.14;
  quick[1].reactionTimeS = 0.15;  // the limit itself is not below
  addHandMadeSession(store(), "a", kProtocol, seen + catches);
  addHandMadeSession(store(), "b", kProtocol, seen + quick);
  addHandMadeSession(store(), "c", kProtocol, seen, "aborted");

  const StudyAnswers study = read();
  EXPECT_THAT(study.observers, ElementsAre("b"));
  EXPECT_EQ(study.answers.size(), 6U);
  for (const StudyAnswer& answer : study.answers) EXPECT_EQ(answer.observer, 0U);
  ASSERT_EQ(study.leftOut.size(), 3U);
  EXPECT_EQ(study.leftOut[0].rule, "unfinished session");
  EXPECT_EQ(study.leftOut[0].observer, "c");
  EXPECT_EQ(study.leftOut[1].rule, "reaction_time_below_s");
  EXPECT_EQ(study.leftOut[1].observer, "b");
  EXPECT_EQ(study.leftOut[1].answers, 1U);
  EXPECT_EQ(study.leftOut[2].rule, "catch_rate_above");
  EXPECT_EQ(study.leftOut[2].observer, "a");
  EXPECT_EQ(study.leftOut[2].answers, 7U);
  EXPECT_EQ(study.leftOut[2].detail, "yes in 2 of 5 catch trials");

  const StudyAnswers everything = read(false);
  EXPECT_THAT(everything.observers, ElementsAre("a", "b"));
  EXPECT_EQ(everything.answers.size(), 14U);
  for (const AppliedRule& rule : everything.rules) EXPECT_FALSE(rule.applied) << rule.name;
}

TEST_F(StudyAnswersTest, RuleThatCannotBeAppliedSaysSo) {
  addHandMadeSession(store(), "a", "task: {type: yes_no}\nexclusions: {lapse_above: 0.1}\n",
                     trials({}, 1, 2));
  const StudyAnswers study = read();
  ASSERT_EQ(study.rules.size(), 1U);
  EXPECT_FALSE(study.rules[0].applied);
  EXPECT_FALSE(study.rules[0].note.empty());
}

TEST_F(StudyAnswersTest, OneProtocolAtATime) {
  addHandMadeSession(store(), "a", kProtocol, trials({}, 1, 2));
  addHandMadeSession(store(), "b", "task: {type: rating}\n", trials({}, 1, 3));
  expectError([&] { read(); }, "--protocol");
  StudyChoice choice;
  choice.codes = true;
  choice.store = store();
  choice.protocol = "task: {type: rating}";
  EXPECT_EQ(readStudyAnswers(choice).answers.size(), 3U);
  choice.protocol = "other";
  expectError([&] { readStudyAnswers(choice); }, "other");
}

TEST_F(StudyAnswersTest, PeopleAndSimulatedObserversAreNotMixed) {
  addHandMadeSession(store(), "a", kProtocol, trials({}, 1, 2), "finished", "1", {{"lab_ready", false}});
  EXPECT_EQ(read().simulated, 0U);
  EXPECT_EQ(read().notLabReady, 1U);
  addHandMadeSession(store(), "b", kProtocol, trials({}, 1, 3), "finished", "1", {{"simulated", true}});
  expectError([&] { read(); }, "--observers");
  StudyChoice choice;
  choice.codes = true;
  choice.store = store();
  choice.observers = Observers::People;
  EXPECT_THAT(readStudyAnswers(choice).observers, ElementsAre("a"));
  choice.observers = Observers::Simulated;
  EXPECT_THAT(readStudyAnswers(choice).observers, ElementsAre("b"));
  EXPECT_EQ(readStudyAnswers(choice).simulated, 1U);
}

TEST_F(StudyAnswersTest, SensitivityByHand) {
  // Corrected rates 3.5 / 5 = 0.7 and 0.5 / 5 = 0.1: z 0.5244005 and -1.2815516.
  addHandMadeSession(store(), "a", kProtocol, trials({}, 3, 4) + trials({}, 0, 4, false));
  const std::vector<PartSensitivity> parts = studySensitivity(read());
  ASSERT_EQ(parts.size(), 1U);
  ASSERT_EQ(parts[0].rows.size(), 2U);
  ASSERT_TRUE(parts[0].rows[0].yesNo);
  EXPECT_NEAR(parts[0].rows[0].yesNo->dPrime, 1.8059521, 1e-6);
  EXPECT_NEAR(parts[0].rows[0].yesNo->criterion, 0.3785755, 1e-6);
  EXPECT_NEAR(parts[0].dPrime->mean, 1.8059521, 1e-6);
}

}  // namespace
}  // namespace limen::analysis
