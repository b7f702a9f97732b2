// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/trace.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "tests/study/procedures/example_settings.h"

namespace limen::study {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const json kStaircase = json::parse(
    R"({"type": "staircase", "stimulus": {"name": "x", "start": 10}, "steps": 2, "stop": {"trials": 4}})");

TEST(Trace, ListsEachTrialWithTheEstimatesAfterIt) {
  const json out = trace(kStaircase, 1, readAnswers("1,0,1", "answers"));
  ASSERT_EQ(out["trials"].size(), 3u);
  // 10 + | 8 - reversal at 8 | 10 + reversal at 10; then 8.
  EXPECT_EQ(out["trials"][0]["stimulus"], json({10.0}));
  EXPECT_EQ(out["trials"][1]["stimulus"], json({8.0}));
  EXPECT_EQ(out["trials"][2]["stimulus"], json({10.0}));
  EXPECT_EQ(out["trials"][2]["outcome"], 1);
  EXPECT_EQ(out["trials"][1]["estimate"]["parameters"][0]["mean"], json(nullptr));
  EXPECT_EQ(out["trials"][2]["estimate"]["parameters"][0]["mean"], 9.0);
  EXPECT_EQ(out["next"], json({8.0}));
  EXPECT_EQ(out["procedure"]["steps_up"], json({2.0}));
  EXPECT_EQ(json::parse(out.dump()), out);
}

TEST(Trace, ReplaysGivenStimuliPastTheEnd) {
  const json out = trace(kStaircase, 1, readAnswers("# published\n7.5:1 3:0, 1 1\n5:0", "answers"));
  EXPECT_EQ(out["trials"][0]["stimulus"], json({7.5}));
  EXPECT_EQ(out["trials"][0]["proposed"], json({10.0}));
  EXPECT_EQ(out["trials"][2]["stimulus"], json({5.0}));  // 3 and a negative answer
  EXPECT_EQ(out["trials"][4]["proposed"], json(nullptr));
  EXPECT_EQ(out["next"], json(nullptr));
  EXPECT_THROW(trace(kStaircase, 1, readAnswers("1 1 1 1 1", "")), Error);
}

TEST(Trace, TakesStimuliOfSeveralDimensions) {
  const auto answers = readAnswers("0.1/2:1\t-4/1e-3:0", "");
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(*answers[0].stimulus, (std::vector<double>{0.1, 2}));
  EXPECT_EQ(*answers[1].stimulus, (std::vector<double>{-4, 1e-3}));
  EXPECT_EQ(answers[1].outcome, 0);
}

TEST(Trace, SlipsInAnswersAreRefused) {
  for (const char* text : {"yes", "1,x", "1.5", "-1", ":1", "3:", "1/:1", "1//2:0", "nan:1", "1:2:3"}) {
    try {
      readAnswers(text, "--answers");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("is not an answer")) << text;
      EXPECT_EQ(error.where(), "--answers");
    }
  }
  try {
    trace(kStaircase, 1, readAnswers("1 0 5", ""), "run");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("trial 3: no outcome 5"));
  }
}

TEST(Trace, EveryTypeCanBeTraced) {
  for (const json& settings : exampleSettings()) {
    const json out = trace(settings, 7, readAnswers("1,0,1,1,0", ""));
    EXPECT_EQ(out["trials"].size(), 5u);
    EXPECT_EQ(trace(settings, 7, readAnswers("1,0,1,1,0", "")).dump(), out.dump());
    EXPECT_FALSE(out["trials"][4]["estimate"]["kind"].get<std::string>().empty());
  }
}

}  // namespace
}  // namespace limen::study
