// SPDX-License-Identifier: BSD-3-Clause
// limen analyse fit on sessions of simulated observers, whose functions the protocol states.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/analysis/result_rows.h"
#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A shipped protocol whose observers are all alike, so that answers of all are those of one function.
std::string withoutSpread(const TemporaryFolder& folder, const std::string& name) {
  std::ifstream in(LIMEN_SOURCE_DIR "/study/protocols/" + name + ".yaml");
  const std::string path = folder.path(name + ".yaml");
  std::ofstream out(path);
  for (std::string line; std::getline(in, line);)
    if (line.find("between_observers") == std::string::npos) out << line << "\n";
  return path;
}

std::string simulate(const TemporaryFolder& folder, const std::string& protocol, int observers,
                     const std::string& kind = "lapsing") {
  const std::string store = folder.path(kind + ".sqlite");
  std::ostringstream call;
  call << "limen-study simulate " << protocol << " --observers " << observers << " --kind " << kind
       << " --seed 3 --quiet --store " << store;
  const ProgramRun run = runProgram(call.str());
  EXPECT_EQ(run.code, 0) << run.text;
  return store;
}

ProgramRun fit(const std::string& arguments) { return runProgram("limen-analyse fit " + arguments); }

json fitted(const std::string& arguments) {
  const ProgramRun run = fit("--json " + arguments);
  EXPECT_EQ(run.code, 0) << run.text;
  return json::parse(run.text, nullptr, false);
}

/// Of eight and more intervals all hold the truth: with 99.9 % each that fails once in a hundred times, for
/// other seeds.
void expectHeld(const json& part, const json& condition, const std::string& quantity, double truth) {
  const json row = rowWith(part.at("parameters"), {{"condition", condition}, {"parameter", quantity}});
  EXPECT_LE(row.at("low").get<double>(), truth) << condition << " " << quantity;
  EXPECT_GE(row.at("high").get<double>(), truth) << condition << " " << quantity;
}

double estimate(const json& part, const json& condition, const std::string& quantity) {
  return rowWith(part.at("parameters"), {{"condition", condition}, {"parameter", quantity}}).at("estimate");
}

TEST(StoreFit, IntervalsHoldWhatExperimentOneSimulates) {
  const TemporaryFolder folder;
  const std::string store = simulate(folder, withoutSpread(folder, "experiment_1"), 20);
  const std::string picture = folder.path("fit.svg");
  const json out =
      fitted(store + " --no-exclusions --intervals profile --confidence 0.999 --plot " + picture);
  EXPECT_EQ(out.at("observers").size(), 20U);
  ASSERT_EQ(out.at("sections").size(), 1U);
  const json& part = out.at("sections").at(0);
  EXPECT_EQ(part.at("part"), "main");
  EXPECT_EQ(part.at("x"), "switch_distance");
  const std::map<std::string, double> thresholds = {{"lod_change=2_to_3, presentation=dynamic", 29.0},
                                                    {"lod_change=2_to_3, presentation=static", 41.0},
                                                    {"lod_change=3_to_9, presentation=dynamic", 14.0},
                                                    {"lod_change=3_to_9, presentation=static", 20.0}};
  ASSERT_EQ(part.at("conditions").size(), thresholds.size());
  for (const json& condition : part.at("conditions")) {
    const json& name = condition.at("condition");
    EXPECT_EQ(part.at("sigmoid"), "logistic");
    EXPECT_EQ(part.at("axis"), "log");
    EXPECT_EQ(part.at("direction"), "falling");
    EXPECT_EQ(part.at("task"), "yesno");
    // Of each distance 20 x 3 changes, and a catch trial to each.
    EXPECT_EQ(condition.at("trials"), 20 * 7 * 4);
    EXPECT_EQ(condition.at("blocks"), 8);
    EXPECT_LT(estimate(part, name, "slope"), 0.0);
    expectHeld(part, name, "threshold", thresholds.at(name));
    expectHeld(part, name, "width", 2.5);
    expectHeld(part, name, "guess", 0.0446);
    expectHeld(part, name, "lapse", 0.02);
  }
  EXPECT_TRUE(std::filesystem::exists(picture));

  // A guess rate held at that of all catch trials, and one condition for each observer.
  const json held = fitted(store + " --no-exclusions --guess catch");
  const json& first = held.at("sections").at(0);
  const double guess = estimate(first, first.at("conditions").at(0).at("condition"), "guess");
  EXPECT_NEAR(guess, 0.0446, 4.0 * std::sqrt(0.0446 * 0.9554 / 560.0));
  EXPECT_EQ(held.at("sections").at(0).at("conditions").at(0).at("trials"), 20 * 7 * 3);
  EXPECT_EQ(fitted(store + " --no-exclusions --by observer --share width,lapse")
                .at("sections")
                .at(0)
                .at("conditions")
                .size(),
            20U);
}

TEST(StoreFit, IntervalsHoldWhatQuestPlusWasGiven) {
  const TemporaryFolder folder;
  const std::string store = simulate(folder, withoutSpread(folder, "threshold_2ifc"), 10, "ideal");
  const json out = fitted(store + " --no-exclusions --intervals profile --confidence 0.999");
  const json& part = out.at("sections").at(0);
  EXPECT_EQ(part.at("x"), "nearness");
  ASSERT_EQ(part.at("conditions").size(), 4U);
  for (const json& condition : part.at("conditions")) {
    const json& name = condition.at("condition");
    EXPECT_EQ(part.at("sigmoid"), "weibull");
    EXPECT_EQ(part.at("direction"), "rising");
    EXPECT_EQ(part.at("task"), "2afc");
    EXPECT_EQ(condition.at("trials"), 400);
    const bool fine = name.get<std::string>().find("fine") != std::string::npos;
    expectHeld(part, name, "threshold", fine ? 0.12 : 0.07);
    expectHeld(part, name, "width", 1.356);
    expectHeld(part, name, "lapse", 0.0);
  }
  // The rows that the session's own export would fit the same way: none is lost.
  const std::string csv = folder.path("fit.csv");
  EXPECT_EQ(fit(store + " --no-exclusions --by none --csv " + csv).code, 0);
  std::ifstream stream(csv);
  const std::string table{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(table, HasSubstr("\nparameters,main,,threshold,"));

  // What the protocol says may be overruled.
  const json other = fitted(store + " --no-exclusions --sigmoid normal --axis linear --level 0.5");
  EXPECT_EQ(other.at("sections").at(0).at("axis"), "linear");
  const ProgramRun text = fit(store + " --direction falling");
  EXPECT_THAT(text.text, HasSubstr("better with the level"));
  EXPECT_THAT(text.text, HasSubstr("simulated observers"));
}

TEST(StoreFit, RefusesWhatMakesNoSense) {
  const TemporaryFolder folder;
  const std::string store = folder.path("s.sqlite"), table = folder.path("t.csv"),
                    protocol = "task: {type: yes_no}\nfactors:\n  size: [1, 2]\n  speed: [3, 4]\n";
  std::ofstream(table) << "x,k,n\n1,9,10\n2,5,10\n3,1,10\n";
  std::vector<HandMadeTrial> answers;
  for (const char* size : {"1", "2"})
    for (const char* speed : {"3", "4"})
      answers = answers + trials({{"size", size}, {"speed", speed}}, *size == '1' ? 2 : 5, 8);
  addHandMadeSession(store, "a", protocol, answers);
  const std::pair<std::string, std::string> cases[] = {
      {store, "--x: size, speed"},
      {store + " --x sise", "--x takes size, speed"},
      {store + " --x size --by colour", "no factor 'colour'"},
      {store + " --x size --part other", "no part 'other'"},
      {store + " --x size --guess catch", "no catch trials"},
      {store + " --x size --guess often", "--guess"},
      {store + " --x size --task 2afc", "--task"},
      {store + " --x size --k yes", "--k"},
      {table + " --x x --k k --n n --part main", "--part"},
      {table + " --x x --k k --n n --no-exclusions", "--no-exclusions"},
      {table + " --k k --n n", "--x"},
      {table + " --x x --k k --n n --direction down", "--direction"}};
  for (const auto& [arguments, words] : cases) {
    const ProgramRun run = fit(arguments);
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_THAT(run.text, HasSubstr(words)) << arguments;
  }
  EXPECT_EQ(fit(store + " --x size").code, 0);

  // A table falls as it says, or as its answers go.
  const std::string columns = " --x x --k k --n n --task yesno ";
  const auto threshold = [&](const std::string& options) {
    const ProgramRun run = fit(table + columns + options + " --json");
    EXPECT_EQ(run.code, 0) << run.text;
    return estimate(json::parse(run.text).at("sections").at(0), "", "threshold");
  };
  EXPECT_NEAR(threshold("--direction falling"), 2.0, 0.01);  // the answers are symmetric
  EXPECT_EQ(threshold("--direction auto"), threshold("--direction falling"));
}

}  // namespace
}  // namespace limen::analysis
