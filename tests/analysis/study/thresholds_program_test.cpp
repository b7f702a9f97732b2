// SPDX-License-Identifier: BSD-3-Clause
// limen analyse thresholds on sessions of simulated observers, whose thresholds the protocol states.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/analysis/result_rows.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ThresholdsProgram, QuestPlusStudyHasThresholdsOfItsObservers) {
  const TemporaryFolder folder;
  const std::string store = folder.path("t.sqlite"), csv = folder.path("t.csv");
  const ProgramRun simulated = runProgram(
      "limen-study simulate threshold_2ifc --observers 10 --seed 4 --quiet --json --store " + store);
  ASSERT_EQ(simulated.code, 0) << simulated.text;
  const json truth = json::parse(simulated.text).at("summary").at("estimates");
  const ProgramRun run =
      runProgram("limen-analyse thresholds --no-exclusions --json --csv " + csv + " " + store);
  ASSERT_EQ(run.code, 0) << run.text;
  const json part = json::parse(run.text).at("sections").at(0);
  ASSERT_EQ(part.at("conditions").size(), 4U);
  EXPECT_EQ(part.at("thresholds").size(), 40U);
  EXPECT_NEAR(part.at("threshold_level").get<double>(), 1.0 - std::exp(-1.0), 1e-9);
  for (const json& condition : part.at("conditions")) {
    // What the sessions' own procedures arrived at, as the simulation summed it up.
    double sum = 0.0;
    for (const json& row : rowsWith(part.at("thresholds"), {{"condition", condition.at("condition")}})) {
      sum += row.at("procedure_estimate").get<double>();
      EXPECT_LT(row.at("procedure_low"), row.at("procedure_estimate"));
      EXPECT_EQ(row.at("trials"), 40);
    }
    const json levels = {{"lod_change", condition.at("lod_change")},
                         {"presentation", condition.at("presentation")}};
    const json own = rowWith(truth, {{"condition", levels}});
    EXPECT_NEAR(sum / 10.0, own.at("mean_estimate").get<double>(), 1e-9);
    // The population's thresholds, 0.12 and 0.07. Four intervals at 95 %.
    const double population = condition.at("lod_change") == "fine" ? 0.12 : 0.07;
    EXPECT_LT(condition.at("low").get<double>(), population) << condition.dump();
    EXPECT_GT(condition.at("high").get<double>(), population) << condition.dump();
  }
  const json pair = rowWith(part.at("pairs"), {{"factor", "lod_change"}});
  EXPECT_TRUE(pair.at("is_ratio"));
  EXPECT_LT(pair.at("low").get<double>(), 0.12 / 0.07);
  EXPECT_GT(pair.at("high").get<double>(), 0.12 / 0.07);
  EXPECT_LT(pair.at("p").get<double>(), 0.001);
  EXPECT_EQ(part.at("effects").size(), 3U);
  std::ifstream stream(csv);
  std::string header;
  std::getline(stream, header);
  EXPECT_THAT(header, StartsWith("table,part,condition,lod_change,presentation,"));

  const ProgramRun text = runProgram("limen-analyse thresholds " + store);
  EXPECT_THAT(text.text, HasSubstr("thresholds of nearness (1/world unit)"));
  EXPECT_THAT(text.text, HasSubstr("by quest_plus"));
  EXPECT_THAT(runProgram("limen-analyse anova " + store).text, HasSubstr("limen analyse thresholds"));
}

TEST(ThresholdsProgram, TitlesOfTheProtocolAreThoseOfFactorsAndAxes) {
  const TemporaryFolder folder;
  std::ifstream in(LIMEN_SOURCE_DIR "/study/protocols/threshold_2ifc.yaml");
  std::string protocol{std::istreambuf_iterator<char>(in), {}};
  const std::string path = folder.path("p.yaml"), store = folder.path("p.sqlite"), key = "titles: {";
  const size_t at = protocol.find(key) + key.size();
  const auto write = [&](const std::string& title) {
    std::ofstream(path) << protocol.substr(0, at) + title + ", " + protocol.substr(at);
  };
  write("nearnes: how near (1/m)");
  EXPECT_THAT(runProgram("limen-study protocol --check " + path).text, HasSubstr("did you mean 'nearness'"));
  write("nearness: how near (1/m)");
  ASSERT_EQ(
      runProgram("limen-study simulate " + path + " --observers 2 --seed 1 --quiet --store " + store).code,
      0);
  EXPECT_THAT(runProgram("limen-analyse thresholds " + store).text,
              HasSubstr("thresholds of how near (1/m)"));
}

TEST(ThresholdsProgram, RefusesWhatHasNone) {
  const TemporaryFolder folder;
  const std::string store = folder.path("e.sqlite");
  ASSERT_EQ(
      runProgram("limen-study simulate experiment_2 --observers 2 --seed 1 --quiet --store " + store).code,
      0);
  const ProgramRun none = runProgram("limen-analyse thresholds " + store);
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.text, HasSubstr("no part has a numeric stimulus variable"));
  EXPECT_EQ(runProgram("limen-analyse thresholds --part object " + store).code, 2);
  EXPECT_EQ(runProgram("limen-analyse thresholds --part missing " + store).code, 2);
}

}  // namespace
}  // namespace limen::analysis
