// SPDX-License-Identifier: BSD-3-Clause
// limen analyse rates, anova, sdt on simulated sessions of experiment I.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(AnalyseStudyProgram, SimulatedExperimentOne) {
  const TemporaryFolder folder;
  const std::string store = folder.path("s.sqlite");
  const ProgramRun simulated =
      runProgram("limen-study simulate experiment_1 --observers 8 --seed 3 --quiet --json --store " + store);
  ASSERT_EQ(simulated.code, 0) << simulated.text;
  const json truth = json::parse(simulated.text).at("summary").at("parts").at(0);

  // The simulation sums up by itself what it made.
  const ProgramRun rates = runProgram("limen-analyse rates --no-exclusions --json " + store);
  ASSERT_EQ(rates.code, 0) << rates.text;
  const json found = json::parse(rates.text);
  int compared = 0;
  for (const json& row : found.at("rates").at("rates")) {
    if (row.at("scope") != "part") continue;
    ++compared;
    const json& own = truth.at(row.at("change").get<bool>() ? "change" : "catch");
    EXPECT_NEAR(row.at("mean").get<double>(), own.at("mean").get<double>(), 1e-9);
    EXPECT_NEAR(row.at("sd").get<double>(), own.at("sd").get<double>(), 1e-9);
    EXPECT_EQ(row.at("pooled").at("trials"), own.at("trials"));
  }
  EXPECT_EQ(compared, 2) << "trials with and without a change";

  // The simulated observers see what the protocol says: large effects of the change of level and of distance.
  // Degrees of freedom as in the thesis.
  const ProgramRun anova = runProgram("limen-analyse anova --no-exclusions --json " + store);
  ASSERT_EQ(anova.code, 0) << anova.text;
  const json part = json::parse(anova.text).at("anova").at(0);
  EXPECT_EQ(part.at("observers"), 8);
  std::map<std::string, json> effects;
  for (const json& effect : part.at("effects")) effects[effect.at("effect")] = effect;
  for (const char* name : {"lod_change", "switch_distance", "presentation"}) {
    ASSERT_EQ(effects.count(name), 1U);
    if (std::string(name) != "presentation") {
      EXPECT_LT(effects[name].at("p").get<double>(), 0.001) << name;
    }
    EXPECT_EQ(effects[name].at("df"), effects[name].at("published").at("df"));
    EXPECT_EQ(effects[name].at("df_error"), effects[name].at("published").at("df_error"));
  }
  EXPECT_EQ(effects["lod_change x switch_distance"].at("published").at("f"), 3.139);
  EXPECT_TRUE(effects["lod_change x presentation"].at("published").is_null());
  const ProgramRun text = runProgram("limen-analyse anova --no-exclusions " + store);
  EXPECT_THAT(text.text, HasSubstr("F(1,7) = 98.926"));

  const ProgramRun sdt = runProgram("limen-analyse sdt --json --no-exclusions " + store);
  ASSERT_EQ(sdt.code, 0) << sdt.text;
  EXPECT_EQ(json::parse(sdt.text).at("sdt").at(0).at("d_prime").at("observers"), 8);
}

TEST(AnalyseStudyProgram, ListsWhatWasLeftOut) {
  const TemporaryFolder folder;
  const std::string store = folder.path("s.sqlite"),
                    protocol =
                        "task: {type: yes_no}\nfactors:\n  d: [a, b]\nexclusions: {catch_rate_above: 0.25}\n";
  addHandMadeSession(store, "good", protocol, trials({{"d", "a"}}, 1, 2) + trials({{"d", "a"}}, 0, 2, false));
  addHandMadeSession(store, "guesser", protocol,
                     trials({{"d", "a"}}, 1, 2) + trials({{"d", "a"}}, 2, 2, false));
  for (const char* command : {"rates", "anova", "sdt"}) {
    const ProgramRun outcome = runProgram(std::string("limen-analyse ") + command + " " + store);
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("left out by catch_rate_above: guesser, 4 answers")) << command;
  }
  const std::string csv = folder.path("rates.csv");
  ASSERT_EQ(runProgram("limen-analyse rates --no-exclusions --csv " + csv + " " + store).code, 0);
  std::ifstream stream(csv);
  const std::string table{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(table, HasSubstr("main,part,all,1,yes,2,0.5,0,"));
  EXPECT_THAT(table, HasSubstr("main,observer,guesser,0,yes,1,1,"));

  EXPECT_EQ(runProgram("limen-analyse rates " + folder.path("none.sqlite")).code, 2);
  const ProgramRun guess = runProgram("limen-analyse validate --guess often " + store);
  EXPECT_EQ(guess.code, 2);
  EXPECT_THAT(guess.text, HasSubstr("--guess"));
}

}  // namespace
}  // namespace limen::analysis
