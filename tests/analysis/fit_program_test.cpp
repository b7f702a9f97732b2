// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/analysis/result_rows.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

ProgramRun fit(const std::string& arguments) { return runProgram("limen-analyse fit " + arguments); }

constexpr const char* kClassic =
    ".0010,45\n.0015,50\n.0020,44\n.0025,44\n.0030,52\n.0035,53\n.0040,62\n.0045,64\n.0050,76\n.0060,79\n."
    "0070,88\n"
    ".0080,90\n.0100,90\n";

/// The classic set under one condition or more.
std::string classicTable(const std::vector<std::string>& conditions) {
  std::string out = "level,correct,trials,condition\n";
  for (const std::string& condition : conditions) {
    std::istringstream lines(kClassic);
    for (std::string line; std::getline(lines, line);) out += line + ",90," + condition + "\n";
  }
  return out;
}

class FitProgram : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path(name)) << text;
    return folder_.path(name);
  }
  const TemporaryFolder folder_;
  const std::string columns_ = " --x level --k correct --n trials ";
};

TEST_F(FitProgram, WordsAreAnswersAndProfileIntervalsTheDefault) {
  std::string numbers = "x,seen\n", words = numbers;
  const std::pair<const char*, const char*> pairs[] = {
      {"yes", "no"}, {"Correct", "wrong"}, {"TRUE", "False"}};
  for (int level = 1; level <= 5; ++level)
    for (int trial = 0; trial < 12; ++trial) {
      const bool seen = trial < 2 * level;
      numbers += std::to_string(level) + (seen ? ",1\n" : ",0\n");
      const auto& [yes, no] = pairs[trial % 3];
      words += std::to_string(level) + "," + (seen ? yes : no) + "\n";
    }
  const std::string call = " --x x --outcome seen --task yesno --json";
  const json a = json::parse(fit(write("n.csv", numbers) + call).text),
             b = json::parse(fit(write("w.csv", words) + call).text);
  EXPECT_EQ(a.at("sections"), b.at("sections"));
  EXPECT_EQ(a.at("sections").at(0).at("interval_method"), "profile");
  EXPECT_LT(a.at("sections").at(0).at("parameters").at(0).at("low").get<double>(), 3.0);
  EXPECT_FALSE(json::parse(fit(write("n.csv", numbers) + call + " --intervals none").text)
                   .at("sections")
                   .at(0)
                   .contains("interval_method"));
  const ProgramRun other = fit(write("o.csv", "x,seen\n1,yes\n2,maybe\n") + call);
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.text, HasSubstr("'maybe' is neither 0 nor 1"));
  EXPECT_THAT(other.text, HasSubstr("yes and no"));
}

TEST_F(FitProgram, PrintsFourDigits) {
  // 0.004647817 in full, as CSV has it.
  const ProgramRun run = fit(write("classic.csv", classicTable({"a"})) + columns_);
  EXPECT_THAT(run.text, HasSubstr("0.004648  "));
  EXPECT_THAT(run.text, testing::Not(HasSubstr("0.0046478")));
  EXPECT_EQ(fit(write("classic.csv", classicTable({"a"})) + columns_ + "--intervals observers").code, 2);
}

TEST_F(FitProgram, SaysTheClassicAnswerInJson) {
  const std::string file = write("classic.csv", classicTable({"a"}));
  const ProgramRun outcome = fit(
      file + columns_ + "--by condition --task 2afc --sigmoid normal --method ml --json --intervals profile");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const json answer = json::parse(outcome.text);
  const json& a = answer.at("sections").at(0);
  const auto parameter = [&](const char* name) {
    return rowWith(a.at("parameters"), {{"condition", "a"}, {"parameter", name}});
  };
  EXPECT_NEAR(parameter("threshold").at("estimate").get<double>(), 0.0046478171, 2e-10);
  EXPECT_NEAR(parameter("width").at("estimate").get<double>(), 0.0046590718, 2e-10);
  EXPECT_NEAR(a.at("conditions").at(0).at("deviance").get<double>(), 5.9328130, 5e-8);
  EXPECT_EQ(parameter("guess").at("estimate"), 0.5);
  EXPECT_EQ(parameter("eta").at("estimate"), 0.0);
  EXPECT_EQ(a.at("sigmoid"), "normal");
  EXPECT_EQ(a.at("interval_method"), "profile");
  EXPECT_EQ(a.at("level"), 0.95);
  EXPECT_LT(parameter("threshold").at("low"), parameter("threshold").at("estimate"));
  EXPECT_GT(parameter("threshold").at("high"), parameter("threshold").at("estimate"));
  EXPECT_TRUE(a.at("notes").is_array());
  EXPECT_THAT(answer.at("versions").dump(), HasSubstr("ceres"));
  EXPECT_EQ(answer.at("sha256").get<std::string>().size(), 64u);
}

TEST_F(FitProgram, TakesSingleTrialsAsItTakesCounts) {
  std::string rows = "when\tlevel\tright\n";
  int when = 0;
  std::istringstream lines(kClassic);
  for (std::string line; std::getline(lines, line);) {
    const size_t comma = line.find(',');
    for (int i = 0; i < 90; ++i)
      rows += std::to_string(when++) + "\t" + line.substr(0, comma) + "\t" +
              (i < std::stoi(line.substr(comma + 1)) ? "1\n" : "0\n");
  }
  const ProgramRun outcome =
      fit(write("trials.tsv", rows) + " --x level --outcome right --order when --json");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const json answer = json::parse(outcome.text);
  EXPECT_NEAR(rowWith(answer.at("sections").at(0).at("parameters"), {{"parameter", "threshold"}})
                  .at("estimate")
                  .get<double>(),
              0.0046478171, 2e-10);
  EXPECT_EQ(answer.at("sections").at(0).at("conditions").at(0).at("trials"), 1170);
}

TEST_F(FitProgram, SharesComparesAndDraws) {
  const std::string file = write("two.csv", classicTable({"a", "b"}));
  const std::string picture = folder_.path("fit.svg");
  const ProgramRun outcome =
      fit(file + columns_ + "--by condition --share lapse,width --json --plot " + picture);
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const json answer = json::parse(outcome.text);
  const json& section = answer.at("sections").at(0);
  EXPECT_EQ(section.at("models").at(0).at("parameters"), 4);
  EXPECT_EQ(section.at("models").at(1).at("parameters"), 6);
  // The same answers twice: nothing is lost by sharing.
  EXPECT_NEAR(section.at("likelihood_ratio").at(0).at("statistic").get<double>(), 0.0, 1e-6);
  EXPECT_NEAR(rowWith(section.at("parameters"), {{"condition", "b"}, {"parameter", "threshold"}})
                  .at("estimate")
                  .get<double>(),
              0.0046478171, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(picture));
}

TEST_F(FitProgram, RepeatsItselfAndWritesTablesForPeopleAndPrograms) {
  const std::string file = write("classic.csv", classicTable({"a"}));
  const std::string call = file + columns_ + "--intervals bca --samples 100 --goodness --seed 4 ";
  const ProgramRun one = fit(call + "--threads 1"), two = fit(call + "--threads 2");
  ASSERT_EQ(one.code, 0) << one.text;
  EXPECT_EQ(one.text, two.text);
  EXPECT_THAT(one.text, testing::ContainsRegex("threshold +0.004648"));
  EXPECT_THAT(one.text, HasSubstr("residuals with order"));
  const std::string csv = folder_.path("out.csv");
  EXPECT_EQ(fit(file + columns_ + "--csv " + csv).code, 0);
  std::ifstream stream(csv);
  const std::string table{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(table, HasSubstr("table,part,condition,parameter,estimate,low,high,"));
  EXPECT_THAT(table, HasSubstr("\nparameters,,,threshold,0.004647817"));
  EXPECT_THAT(fit(file + columns_ + "--method map --fix lapse=0.01").text, HasSubstr("fixed: lapse = 0.01"));
}

TEST_F(FitProgram, RefusesBadInputWithCodeTwoAndOneLine) {
  const std::string good = write("good.csv", classicTable({"a"}));
  const std::pair<std::string, std::string> cases[] = {
      {"", "DATA"},
      {folder_.path("none.csv") + columns_, "no such file"},
      {good + " --x levl --k correct --n trials", "did you mean 'level'"},
      {good + " --x level --k correct", "--n"},
      {good + columns_ + "--outcome correct", "not both"},
      {good + " --x level --outcome correct", "neither 0 nor 1"},
      {good + columns_ + "--sigmoid norml", "did you mean 'normal'"},
      {good + columns_ + "--task 3afc", "mafc:M"},
      {good + columns_ + "--fix lapse", "lapse=0.01"},
      {good + columns_ + "--fix lapsus=0.1", "did you mean 'lapse'"},
      {good + columns_ + "--intervals basic", "no intervals 'basic'"},
      {good + columns_ + "--samples 5", "--samples"},
      {good + columns_ + "--confidence 95", "--confidence"},
      {good + columns_ + "--plot x.gif", ".svg"},
      {good + columns_ + "--colour", "unknown argument"},
      {write("bad.csv", "level,correct,trials\n1,11,10\n") + columns_,
       "bad.csv:2, column 'correct': 11 correct of 10"},
      {write("text.csv", "level,correct,trials\n1,x,10\n") + columns_,
       "text.csv:2, column 'correct': 'x' is not a number"},
      {write("one.csv", "level,correct,trials\n1,1,10\n") + columns_, "one level"}};
  for (const auto& [arguments, words] : cases) {
    const ProgramRun outcome = fit(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.text, HasSubstr(words)) << arguments;
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
  }
}

}  // namespace
}  // namespace limen::analysis
