// SPDX-License-Identifier: BSD-3-Clause
// limen analyse rates, anova, sdt on simulated sessions of experiment I.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "tests/analysis/result_rows.h"
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
  for (const json& row : found.at("sections").at(0).at("rates")) {
    if (row.at("scope") != "part") continue;
    ++compared;
    const json& own = truth.at(row.at("change").get<bool>() ? "change" : "catch");
    EXPECT_NEAR(row.at("estimate").get<double>(), own.at("mean").get<double>(), 1e-9);
    EXPECT_NEAR(row.at("sd").get<double>(), own.at("sd").get<double>(), 1e-9);
    EXPECT_EQ(row.at("trials"), own.at("trials"));
  }
  EXPECT_EQ(compared, 2) << "trials with and without a change";

  // The simulated observers see what the protocol says: large effects of the change of level and of distance.
  // Degrees of freedom as in the thesis.
  const ProgramRun anova = runProgram("limen-analyse anova --no-exclusions --json " + store);
  ASSERT_EQ(anova.code, 0) << anova.text;
  const json part = json::parse(anova.text).at("sections").at(0);
  EXPECT_EQ(part.at("observers"), 8);
  std::map<std::string, json> effects;
  for (const json& effect : part.at("effects")) effects[effect.at("effect")] = effect;
  for (const char* name : {"lod_change", "switch_distance", "presentation"}) {
    ASSERT_EQ(effects.count(name), 1U);
    if (std::string(name) != "presentation") {
      EXPECT_LT(effects[name].at("p").get<double>(), 0.001) << name;
    }
    EXPECT_EQ(effects[name].at("df"), effects[name].at("published_df"));
    EXPECT_EQ(effects[name].at("df_error"), effects[name].at("published_df_error"));
  }
  EXPECT_EQ(effects["lod_change x switch_distance"].at("published_f"), 3.139);
  EXPECT_TRUE(effects["lod_change x presentation"].at("published_f").is_null());
  const ProgramRun text = runProgram("limen-analyse anova --no-exclusions " + store);
  EXPECT_THAT(text.text, HasSubstr("F(1,7) = 98.926"));

  const ProgramRun sdt = runProgram("limen-analyse sdt --json --no-exclusions " + store);
  ASSERT_EQ(sdt.code, 0) << sdt.text;
  EXPECT_EQ(json::parse(sdt.text).at("sections").at(0).at("means").at(0).at("observers"), 8);
}

// Every number of the comparison is that of the command that works it out.
TEST(AnalyseStudyProgram, PublishedStatisticsBesideThoseOfTheOtherCommands) {
  const TemporaryFolder folder;
  const std::string first = folder.path("1.sqlite"), second = folder.path("2.sqlite"),
                    csv = folder.path("c.csv");
  ASSERT_EQ(
      runProgram("limen-study simulate experiment_1 --observers 8 --seed 5 --quiet --store " + first).code,
      0);
  ASSERT_EQ(
      runProgram("limen-study simulate experiment_2 --observers 12 --seed 5 --quiet --store " + second).code,
      0);
  const ProgramRun run =
      runProgram("limen-analyse published --no-exclusions --json --csv " + csv + " " + first + " " + second);
  ASSERT_EQ(run.code, 0) << run.text;
  const json all = json::parse(run.text);
  ASSERT_EQ(all.at("sections").size(), 2U);
  EXPECT_EQ(all.at("stores").at(1).at("protocol"), "experiment_2");
  size_t numbers = 0, effects = 0, rates = 0;
  for (const auto& [store, index, statistics] : {std::tuple{first, 0, 14}, std::tuple{second, 1, 24}}) {
    const json& one = all.at("sections").at(static_cast<size_t>(index));
    EXPECT_EQ(one.at("data"), "simulated: lapsing");
    EXPECT_THAT(one.at("notes").dump(), HasSubstr("no evidence about people"));
    std::map<std::string, json> found;
    std::set<std::string> named;
    for (const json& value : one.at("statistics")) {
      const std::string name =
          value.at("part").get<std::string>() + " " + value.at("statistic").get<std::string>();
      ++numbers;
      named.insert(name);
      found[name + " " + value.at("quantity").get<std::string>()] = value;
    }
    EXPECT_EQ(named.size(), static_cast<size_t>(statistics));
    const json anova = json::parse(runProgram("limen-analyse anova --no-exclusions --json " + store).text);
    for (const json& part : anova.at("sections"))
      for (const json& effect : part.at("effects")) {
        if (effect.at("published_f").is_null()) continue;
        ++effects;
        const std::string name =
            part.at("part").get<std::string>() + " variance by " + effect.at("effect").get<std::string>();
        const std::pair<const char*, const char*> pairs[] = {
            {"F", "f"}, {"df", "df"}, {"df error", "df_error"}, {"p", "p"}};
        for (const auto& [ours, theirs] : pairs)
          EXPECT_EQ(found.at(name + " " + ours).at("estimate"), effect.at(theirs)) << name << " " << ours;
        // As many observers and levels as the thesis had.
        EXPECT_EQ(found.at(name + " df").at("difference"), 0.0);
        EXPECT_EQ(found.at(name + " df error").at("difference"), 0.0);
      }
    const json table = json::parse(runProgram("limen-analyse rates --no-exclusions --json " + store).text);
    for (const json& section : table.at("sections"))
      for (const json& row : section.at("rates")) {
        if (row.at("published").is_null()) continue;
        ++rates;
        const std::string name = section.at("part").get<std::string>() + " detection rate, " +
                                 (row.at("change").get<bool>() ? "trials with a change" : "catch trials");
        EXPECT_EQ(found.at(name + " mean").at("estimate"), row.at("estimate")) << name;
        EXPECT_EQ(found.at(name + " sd").at("estimate"), row.at("sd")) << name;
      }
    for (const json& section : table.at("sections"))
      for (const json& row : section.at("over_scenarios")) {
        if (row.at("published").is_null()) continue;
        const std::string of = row.at("quantity") == "rate" ? "terrain detection rate of static scenarios "
                                                            : "terrain mean severity of static scenarios ";
        EXPECT_EQ(section.at("part"), "terrain");
        EXPECT_EQ(row.at("presentation"), "static");
        EXPECT_EQ(found.at(of + "mean").at("estimate"), row.at("estimate"));
        EXPECT_EQ(found.at(of + "sd").at("estimate"), row.at("sd_of_n"));
      }
  }
  EXPECT_EQ(effects, 8U);
  EXPECT_EQ(rates, 6U);
  std::ifstream stream(csv);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(static_cast<size_t>(std::count(text.begin(), text.end(), '\n')), numbers + 1);

  const std::string other = folder.path("3.sqlite");
  ASSERT_EQ(runProgram("limen-study simulate quick --observers 1 --quiet --store " + other).code, 0);
  const ProgramRun none = runProgram("limen-analyse published " + other);
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.text, HasSubstr("experiment_1, experiment_2"));
  EXPECT_EQ(runProgram("limen-analyse published " + folder.path("none.sqlite")).code, 2);
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
    EXPECT_THAT(outcome.text, testing::ContainsRegex("O02 +catch_rate_above +4")) << command;
  }
  const std::string csv = folder.path("rates.csv");
  ASSERT_EQ(runProgram("limen-analyse rates --no-exclusions --csv " + csv + " " + store).code, 0);
  std::ifstream stream(csv);
  const std::string table{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(table, HasSubstr("\nrates,main,part,all,,1,yes,2,0.5,"));
  EXPECT_THAT(table, HasSubstr("O02"));
  EXPECT_THAT(table, testing::Not(HasSubstr("guesser")));

  EXPECT_EQ(runProgram("limen-analyse rates " + folder.path("none.sqlite")).code, 2);
  const ProgramRun guess = runProgram("limen-analyse validate --guess often " + store);
  EXPECT_EQ(guess.code, 2);
  EXPECT_THAT(guess.text, HasSubstr("--guess"));
}

}  // namespace
}  // namespace limen::analysis
