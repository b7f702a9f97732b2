// SPDX-License-Identifier: BSD-3-Clause
// limen analyse correlate and scale on simulated sessions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json call(const std::string& arguments) {
  const ProgramRun run = runProgram("limen-analyse " + arguments);
  EXPECT_EQ(run.code, 0) << run.text;
  return run.code == 0 ? json::parse(run.text) : json();
}

/// Rows of a CSV without quoted fields, by column.
std::vector<std::map<std::string, std::string>> readCsv(const std::string& path) {
  std::ifstream stream(path);
  std::vector<std::string> header;
  std::vector<std::map<std::string, std::string>> out;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream fields(line);
    std::vector<std::string> values;
    for (std::string field; std::getline(fields, field, ',');) values.push_back(field);
    if (header.empty()) {
      header = values;
      continue;
    }
    values.resize(header.size());
    out.emplace_back();
    for (size_t i = 0; i < header.size(); ++i) out.back()[header[i]] = values[i];
  }
  return out;
}

TEST(AnalyseRelationsProgram, ScaleOfASimulatedStudy) {
  const TemporaryFolder folder;
  const std::string store = folder.path("pairs.sqlite");
  const ProgramRun simulated =
      runProgram("limen-study simulate quality_pairs --observers 10 --seed 5 --quiet --store " + store);
  ASSERT_EQ(simulated.code, 0) << simulated.text;
  const std::string model = " --model thurstone --no-exclusions --json ";
  const json group = call("scale " + store + model + "--samples 500").at("sections").at(0);

  // What the protocol's `simulation` block says. An observer chooses by Phi((b - a) / sqrt 2), values
  // differing between observers with an SD of 0.3 each, so that over observers the difference of two
  // impressions has an SD of sqrt(2 (1 + 0.3^2)), which is the unit of the scale. Lapses (2 %) pull values
  // together by 3 % at most here.
  const std::map<std::string, double> truth = {{"hard", 0.0},        {"pcf", 0.6},
                                               {"pcss", 1.0},        {"bitmask_8", 1.2},
                                               {"bitmask_16", 1.5},  {"bitmask_jittered_16", 1.6},
                                               {"sampled_1024", 1.8}};
  double mean = 0.0;
  for (const auto& [name, value] : truth) mean += value / 7.0;
  EXPECT_EQ(group.at("judgements"), 10 * 84);
  EXPECT_EQ(group.at("subjects"), 10);
  EXPECT_EQ(group.at("bootstrap_over"), "subjects");
  ASSERT_EQ(group.at("items").size(), 7U);
  int held = 0, heldByBootstrap = 0;
  std::vector<std::pair<double, double>> found;
  for (const json& item : group.at("items")) {
    const double expected = (truth.at(item.at("item")) - mean) / std::sqrt(2.18);
    const auto holds = [&](const std::string& name) {
      return item.at(name + "low").get<double>() <= expected &&
                     expected <= item.at(name + "high").get<double>()
                 ? 1
                 : 0;
    };
    held += holds("");
    heldByBootstrap += holds("bootstrap_");
    found.emplace_back(item.at("estimate"), truth.at(item.at("item")));
    EXPECT_NEAR(item.at("estimate").get<double>(), expected, 4.0 * item.at("standard_error").get<double>());
  }
  // Observers differ, which the errors do not know: of 100 such studies 90 % of these intervals held the
  // truth, 91 % of the bootstrap's. Two of seven may miss it (chance of more: 3 %).
  EXPECT_GE(held, 5);
  EXPECT_GE(heldByBootstrap, 5);
  EXPECT_THAT(group.at("notes").at(0).get<std::string>(), HasSubstr("10 different subjects are few"));
  // Items that are 0.4 apart, some two standard errors of their difference and more, come in their order.
  for (const auto& [a, trueA] : found)
    for (const auto& [b, trueB] : found)
      if (trueA > trueB + 0.35) {
        EXPECT_GT(a, b);
      }
  // Every pair once in each order and scene: four rounds each.
  ASSERT_EQ(group.at("consistency").size(), 10U);
  for (const json& one : group.at("consistency")) EXPECT_EQ(one.at("rounds"), 4);
  EXPECT_EQ(group.at("first_judged"), 840);

  // The same answers, exported and put into columns of names.
  const std::string exported = folder.path("export"), csv = folder.path("pairs.csv");
  ASSERT_EQ(runProgram("limen-study export --codes " + store + " -o " + exported).code, 0);
  std::ofstream rows(csv);
  rows << "left,right,chosen,who,round\n";
  for (auto& row : readCsv(exported + "/trials.csv")) {
    if (row["counts"] != "1" || row["practice"] == "1") continue;
    const bool bRight = row["target"] == "1";
    const std::string left = row[bRight ? "condition_item_a" : "condition_item_b"],
                      right = row[bRight ? "condition_item_b" : "condition_item_a"];
    rows << left << "," << right << "," << (row["answer"] == "left" ? left : right) << "," << row["subject"]
         << "," << row["target"] << row["condition_scene"] << "\n";
  }
  rows.close();
  json table =
      call("scale " + csv +
           " --first left --second right --chosen chosen --subject who --round round --model thurstone "
           "--samples 500 --json")
          .at("sections")
          .at(0);
  EXPECT_EQ(table.at("first_chosen"), group.at("first_chosen"));
  const auto triads = [](const json& from) {
    std::map<std::string, double> out;
    for (const json& one : from.at("consistency")) out[one.at("subject")] = one.at("circular_triads");
    return out;
  };
  EXPECT_EQ(triads(table), triads(group));
  for (size_t i = 0; i < 7; ++i) {
    const json &a = group.at("items")[i], &b = table.at("items")[i];
    EXPECT_EQ(a.at("item"), b.at("item"));
    EXPECT_EQ(a.at("chosen"), b.at("chosen"));
    EXPECT_NEAR(a.at("estimate").get<double>(), b.at("estimate").get<double>(), 1e-9);
    for (const char* side : {"bootstrap_low", "bootstrap_high"})
      EXPECT_NEAR(a.at(side).get<double>(), b.at(side).get<double>(), 1e-9);
  }

  const json scenes = call("scale " + store + model + "--by scene --samples 0").at("sections");
  ASSERT_EQ(scenes.size(), 2U);
  EXPECT_EQ(scenes[0].at("judgements"), 420);
  EXPECT_EQ(scenes[0].at("group"), "scene=bunny") << "as the protocol writes them";
  EXPECT_EQ(scenes[1].at("group"), "scene=columns_hall");
  const ProgramRun factor = runProgram("limen-analyse scale --by scenes " + store);
  EXPECT_EQ(factor.code, 2);
  EXPECT_THAT(factor.text, HasSubstr("did you mean 'scene'"));
  const ProgramRun column = runProgram("limen-analyse scale --winner a " + store);
  EXPECT_EQ(column.code, 2);
  EXPECT_THAT(column.text, HasSubstr("--winner"));
  const ProgramRun nothing = runProgram("limen-analyse correlate " + store);
  EXPECT_EQ(nothing.code, 2);
  EXPECT_THAT(nothing.text, HasSubstr("limen analyse scale"));
}

TEST(AnalyseRelationsProgram, MeasuresOfAHandMadeStudy) {
  const TemporaryFolder folder;
  const std::string store = folder.path("s.sqlite");
  const std::string protocol =
      "task: {type: yes_no}\nfactors:\n  d: [near, middle, far]\n  presentation: [static, dynamic]\n";
  // Of four trials each: how many were noticed, by whom.
  const int yes[2][3][2] = {{{4, 4}, {2, 3}, {1, 0}}, {{4, 2}, {3, 1}, {0, 1}}};
  const char* levels[] = {"near", "middle", "far"};
  for (int observer = 0; observer < 2; ++observer) {
    std::vector<HandMadeTrial> all;
    for (int d = 0; d < 3; ++d)
      for (const bool dynamic : {false, true}) {
        auto own = trials({{"d", levels[d]}, {"presentation", dynamic ? "dynamic" : "static"}},
                          yes[observer][d][dynamic ? 1 : 0], 4);
        for (size_t i = 0; i < own.size(); ++i) {
          own[i].presentation = dynamic ? "dynamic" : "static";
          own[i].reactionTimeS = 1.0 + d + 0.1 * static_cast<double>(i);
          if (own[i].outcome == 1) own[i].severity = 4 - d;
        }
        all = all + own;
      }
    addHandMadeSession(store, "o" + std::to_string(observer), protocol, all);
  }
  const auto relations = [&] {
    std::map<std::string, json> out;
    const json result = call("correlate --json " + store);
    for (const json& one : result.at("sections").at(0).at("coefficients"))
      out[one.at("x").get<std::string>() + " / " + one.at("y").get<std::string>()][one.at("coefficient")] =
          one;
    return out;
  };
  auto found = relations();
  EXPECT_EQ(found.size(), 4U);
  // Mean rates: static 1, 5/8, 1/8; dynamic 3/4, 1/2, 1/8. From the deviations by hand: static (10, 1, -11) /
  // 24, dynamic (7, 1, -8) / 24, so r = (70 + 1 + 88) / sqrt((100 + 1 + 121) (49 + 1 + 64)).
  const json& still = found.at("detection_rate, static / detection_rate, dynamic");
  EXPECT_EQ(still.at("pearson").at("n"), 3);
  EXPECT_NEAR(still.at("pearson").at("estimate").get<double>(), 159.0 / std::sqrt(222.0 * 114.0), 1e-9);
  // Six conditions. Severity is 4, 3, 2 and reaction time 1.15, 2.15, 3.15 by distance alone.
  const json& severity = found.at("median_reaction_time_s / mean_severity");
  EXPECT_EQ(severity.at("pearson").at("n"), 6);
  EXPECT_NEAR(severity.at("pearson").at("estimate").get<double>(), -1.0, 1e-9);
  // The nearer, the larger each rate: 12 of 15 pairs. The other 3 are tied by distance, one of them in rate
  // too.
  const json& time = found.at("median_reaction_time_s / detection_rate");
  EXPECT_NEAR(time.at("kendall_tau_b").at("estimate").get<double>(), -12.0 / std::sqrt(12.0 * 14.0), 1e-9);

  // A predictor that is the reverse of distance, for all six stimuli.
  for (int d = 0; d < 3; ++d)
    for (const bool dynamic : {false, true}) {
      HandMadeTrial one;
      one.presentation = dynamic ? "dynamic" : "static";
      one.condition = {{"d", levels[d]}, {"presentation", one.presentation}};
      addHandMadePrediction(store, handMadeHash(one), {{"rating", 3 - d}});
    }
  found = relations();
  const json& rating = found.at("rating / detection_rate");
  EXPECT_EQ(rating.at("pearson").at("n"), 6);
  EXPECT_NEAR(rating.at("kendall_tau_b").at("estimate").get<double>(), 12.0 / std::sqrt(12.0 * 14.0), 1e-9);
  EXPECT_THAT(runProgram("limen-analyse correlate --clamp " + store).text, HasSubstr("Pearson, clamped"));
}

}  // namespace
}  // namespace limen::analysis
