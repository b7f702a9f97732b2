// SPDX-License-Identifier: BSD-3-Clause
// The page of a study whose stimuli a procedure chose: thresholds first, words and units on its axes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/study/study_page_fixture.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

class StudyPageThresholdsTest : public StudyPages {};

const char* const kGapProtocol =
    "question: \"How wide?\"\n"
    "task: {type: yes_no}\n"
    "factors:\n  gap_kind: [very_fine, coarse]\n"
    "titles: {gap_size: width of the gap}\n"
    "procedure:\n  type: quest_plus\n  model: logistic\n"
    "  stimulus: {name: gap_size, from: 1, to: 50, count: 50, unit: px}\n"
    "  parameters: {threshold: {from: 1, to: 40, count: 40}, slope: [0.5, 1, 2], guess: 0.01, lapse: 0.01}\n"
    "  stop: {trials: 40}\n";

/// Met by the logistic function with its middle at `threshold` and the logit ln 3 one pixel away from it.
std::vector<HandMadeTrial> answersAround(const char* kind, double threshold) {
  std::vector<HandMadeTrial> out;
  for (const auto& [x, yes, count] :
       {std::tuple{threshold - 1.0, 10, 40}, std::tuple{threshold + 1.0, 30, 40}, std::tuple{50.0, 20, 20}}) {
    std::vector<HandMadeTrial> own = trials({{"gap_kind", kind}}, yes, count);
    for (HandMadeTrial& trial : own) trial.axes = {x};
    out = out + own;
  }
  std::vector<HandMadeTrial> catches = trials({{"gap_kind", kind}}, 0, 20, false);
  for (HandMadeTrial& trial : catches) trial.axes = {50.0};
  return out + catches;
}

TEST_F(StudyPageThresholdsTest, ThresholdsComeBeforeRatesAndAnswerTheQuestion) {
  addHandMadeSession(store(), "a", kGapProtocol,
                     answersAround("very_fine", 10.0) + answersAround("coarse", 6.0));
  addHandMadeSession(store(), "b", kGapProtocol,
                     answersAround("very_fine", 12.0) + answersAround("coarse", 9.0));
  addHandMadeSession(store(), "c", kGapProtocol,
                     answersAround("very_fine", 14.0) + answersAround("coarse", 9.0));
  const std::string page = writePage();
  const size_t thresholds = page.find("id=\"thresholds\""), functions = page.find("id=\"psychometric\""),
               rates = page.find("id=\"rates\"");
  ASSERT_NE(thresholds, std::string::npos);
  EXPECT_LT(thresholds, functions);
  EXPECT_LT(functions, rates);
  // Means 12 and 8; t of two degrees of freedom is 4.302653: 12 +- 4.302653 x 2 / sqrt(3) = 7.03 to 16.97.
  EXPECT_THAT(
      page, HasSubstr("The threshold of width of the gap (px), mean over 3 observers, is 12 [7.03 to 17] for "
                      "very fine and 8 ["));
  const std::string figure = file("figures/thresholds_main.gp");
  EXPECT_THAT(figure, HasSubstr("threshold of width of the gap (px)"));
  EXPECT_THAT(figure, HasSubstr("very fine"));
  for (const char* name : {"thresholds_main", "psychometric_main", "rates_main"})
    EXPECT_THAT(file(std::string("figures/") + name + ".gp"), Not(HasSubstr("gap_"))) << name;
  EXPECT_THAT(file("tables/thresholds.csv"), HasSubstr("table,part,condition,gap_kind,"));
  EXPECT_THAT(file("tables/psychometric.csv"), HasSubstr("table,part,condition,gap_kind,"));
  EXPECT_THAT(file("methods.txt"), HasSubstr("Cousineau and Morey"));
  // Twice 40 answers and 20 at each of the levels: the area of points is by them.
  EXPECT_THAT(page, HasSubstr("The area of points is by their trials, "));
}

TEST_F(StudyPageThresholdsTest, RatesAnswerWhereNothingIsNumeric) {
  const char* protocol = "task: {type: yes_no}\nfactors:\n  lod_kind: [near_by, far]\n";
  for (const char* code : {"a", "b"})
    addHandMadeSession(store(), code, protocol,
                       trials({{"lod_kind", "near_by"}}, 10, 10) + trials({{"lod_kind", "far"}}, 5, 10) +
                           trials({{"lod_kind", "far"}}, 1, 10, false));
  const std::string page = writePage();
  EXPECT_THAT(page,
              HasSubstr("2 observers reported a change in 75.0 % of the trials with one and 10.0 % of those "
                        "without: 100.0 % for near by and 50.0 % for far."));
  EXPECT_THAT(file("figures/rates_main.gp"), HasSubstr("set xlabel 'lod kind, 20 trials a point'"));
}

}  // namespace
}  // namespace limen::analysis
