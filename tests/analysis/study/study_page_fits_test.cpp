// SPDX-License-Identifier: BSD-3-Clause
// Psychometric functions and scales on the page of a study, of answers that leave one solution, which is
// worked out here.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "tests/analysis/statistics/expect.h"
#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/study/study_page_fixture.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

// Quantile 0.95 of chi-squared with 1 degree of freedom, 0.975 of the normal distribution (any table).
constexpr double kChiSquared1 = 3.841458820694124, kNormal975 = 1.959963984540054;

const char* const kSizeProtocol =
    "task: {type: yes_no}\nfactors:\n  size: [4, 6, 40]\n"
    "simulation: {variable: size, sigmoid: logistic}\n";

class StudyPageFitsTest : public StudyPages {};

/// Rows of a CSV without quotes in it, under the names of their columns.
std::vector<std::map<std::string, std::string>> csvRows(const std::string& text) {
  const auto cellsOf = [](const std::string& line) {
    std::vector<std::string> out;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) out.push_back(cell);
    return out;
  };
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  line.erase(std::remove(line.begin(), line.end(), '\r'), line.end());
  const std::vector<std::string> names = cellsOf(line);
  std::vector<std::map<std::string, std::string>> out;
  while (std::getline(lines, line)) {
    line.erase(std::remove(line.begin(), line.end(), '\r'), line.end());
    const std::vector<std::string> cells = cellsOf(line);
    out.emplace_back();
    for (size_t i = 0; i < cells.size() && i < names.size(); ++i) out.back()[names[i]] = cells[i];
  }
  return out;
}

std::map<std::string, std::string> rowOf(const std::string& csv, const std::string& column,
                                         const std::string& value) {
  for (const auto& row : csvRows(csv))
    if (row.count(column) && row.at(column) == value) return row;
  ADD_FAILURE() << "no row with " << column << " " << value << " in " << csv;
  return {};
}

/// Of 20 trials without a change none is reported; 10 of 40, 30 of 40 and all of 20 with one. Of one
/// observer, or of two with half each.
void addAnswersWithOneSolution(const std::string& store, int observers) {
  const int each = 20 / observers;
  for (int i = 0; i < observers; ++i)
    addHandMadeSession(store, i == 0 ? "a" : "b", kSizeProtocol,
                       trials({{"size", "4"}}, each / 2, 2 * each) +
                           trials({{"size", "6"}}, 3 * each / 2, 2 * each) +
                           trials({{"size", "40"}}, each, each) + trials({{"size", "40"}}, 0, each, false));
}

/// Twice the log-likelihood that the answers above miss with a logistic function.
double devianceOf(double threshold, double width, double guess, double lapse) {
  struct Shown {
    double yes, trials, f;
  };
  const auto f = [&](double x) {
    return 1.0 / (1.0 + std::exp(-2.0 * std::log(19.0) * (x - threshold) / width));
  };
  double out = 0.0;
  for (const Shown& one : {Shown{0, 20, 0.0}, {10, 40, f(4.0)}, {30, 40, f(6.0)}, {20, 20, f(40.0)}}) {
    const double p = std::min(guess + (1.0 - guess - lapse) * one.f, 1.0), no = one.trials - one.yes;
    if (one.yes > 0) out += 2.0 * one.yes * std::log(one.yes / one.trials / p);
    if (no > 0) out += 2.0 * no * std::log(no / one.trials / (1.0 - p));
  }
  return out;
}

TEST_F(StudyPageFitsTest, FunctionThatMeetsAllAnswersIsFound) {
  addAnswersWithOneSolution(store(), 1);
  const std::string page = writePage();
  const std::string csv = file("tables/psychometric.csv");
  const auto row = [&](const char* name) { return rowOf(csv, "parameter", name); };
  // Without guesses and lapses F(4) = 1/4 and F(6) = 3/4 are met by the threshold 5 and, as ln 3 of the
  // logit is one unit of x, by the width 2 ln 19 / ln 3; F(40) misses 1 by less than 1e-16.
  EXPECT_NEAR(std::stod(row("threshold")["estimate"]), 5.0, 1e-4);
  EXPECT_NEAR(std::stod(row("width")["estimate"]), 2.0 * std::log(19.0) / std::log(3.0), 1e-3);
  EXPECT_NEAR(std::stod(row("guess")["estimate"]), 0.0, 1e-5);
  EXPECT_NEAR(std::stod(row("lapse")["estimate"]), 0.0, 1e-5);
  EXPECT_NEAR(std::stod(rowOf(csv, "table", "conditions")["deviance"]), 0.0, 1e-3);
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">5</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">5.36</td>"));
  // The guess rate g that misses chi-squared by -40 ln(1 - g).
  EXPECT_THAT(page, HasSubstr(fmt::format(" to {:.4g}</td>", 1.0 - std::exp(-kChiSquared1 / 40.0))));

  // With a guess rate g the shares at 4, 6 and 40 are still met, and 20 answers of no miss -40 ln(1 - g);
  // with a lapse rate the same holds for the 20 at 40.
  const double most = 1.0 - std::exp(-kChiSquared1 / 40.0);
  EXPECT_NEAR(std::stod(row("guess")["high"]), most, 1e-3);
  EXPECT_NEAR(std::stod(row("lapse")["high"]), most, 1e-3);
  EXPECT_EQ(row("guess")["interval_method"], "profile");

  // At either end of the threshold's interval no other values miss less than the quantile: over a grid.
  for (const char* side : {"low", "high"}) {
    const double threshold = std::stod(row("threshold")[side]);
    double least = INFINITY;
    for (double width = 0.5; width < 15.0; width += 0.05)
      for (double guess = 0.0; guess < 0.2; guess += 0.005)
        for (double lapse = 0.0; lapse <= 0.1; lapse += 0.005)
          least = std::min(least, devianceOf(threshold, width, guess, lapse));
    EXPECT_NEAR(least, kChiSquared1, 0.02) << side << " " << threshold;
  }
}

TEST_F(StudyPageFitsTest, FiguresNotesAndMethodsSayWhatWasFitted) {
  addAnswersWithOneSolution(store(), 2);
  const std::string page = writePage();
  EXPECT_THAT(page, HasSubstr("id=\"psychometric\""));
  EXPECT_THAT(page, HasSubstr("2 observers pooled"));
  EXPECT_THAT(page, HasSubstr("simulated studies"));  // how well such intervals do
  const std::string data = file("figures/psychometric_main.dat");
  EXPECT_THAT(data, HasSubstr("\n4 25 40\n6 75 40\n40 100 20\n"));
  EXPECT_THAT(data, HasSubstr(" 0 20\n"));  // no change
  const std::string methods = file("methods.txt");
  EXPECT_THAT(methods, HasSubstr("of size (logistic F, rising on a linear axis; guess rate fitted up to 0.5, "
                                 "lapse rate fitted up to 0.1)"));
  EXPECT_THAT(methods, HasSubstr("maximum likelihood"));
  EXPECT_THAT(methods, HasSubstr("jackknife over observers"));
  EXPECT_THAT(methods, HasSubstr("No result on this page rests on random numbers."));
}

TEST_F(StudyPageFitsTest, PartsThatAreNotFittedSayWhy) {
  addHandMadeSession(
      store(), "a", "task: {type: yes_no}\nfactors:\n  size: [4, 6]\n  speed: [1, 2]\n",
      trials({{"size", "4"}, {"speed", "1"}}, 1, 2) + trials({{"size", "6"}, {"speed", "2"}}, 2, 2));
  const std::string page = writePage();
  EXPECT_THAT(page, HasSubstr("Part main was not fitted: has several numeric variables."));
  EXPECT_THAT(page, Not(HasSubstr("psychometric_main")));
  EXPECT_THAT(file("methods.txt"), Not(HasSubstr("Psychometric functions")));
}

TEST_F(StudyPageFitsTest, NamedLevelsHaveNoFunction) {
  addHandMadeSession(store(), "a", "task: {type: yes_no}\nfactors:\n  d: [near, far]\n",
                     trials({{"d", "near"}}, 1, 2) + trials({{"d", "far"}}, 1, 2));
  const std::string page = writePage();
  EXPECT_THAT(page, Not(HasSubstr("id=\"psychometric\"")));
  EXPECT_THAT(page, Not(HasSubstr("id=\"scales\"")));
}

const char* const kPairProtocol = "task: {type: pairwise}\nfactors:\n  item_a: [fine]\n  item_b: [coarse]\n";

/// So many for `fine`. The second item is at position 0, so that an outcome of 1 is for the first.
std::vector<HandMadeTrial> judgements(int fine, int count) {
  return trials({{"item_a", "fine"}, {"item_b", "coarse"}}, fine, count);
}

TEST_F(StudyPageFitsTest, TwoItemsAreApartByTheLogitOfTheShare) {
  addHandMadeSession(store(), "a", kPairProtocol, judgements(14, 20));
  addHandMadeSession(store(), "b", kPairProtocol, judgements(16, 20));
  const std::string page = writePage();
  // 30 of 40: ln 3 apart, with the standard error of a logit.
  const double apart = std::log(3.0), error = std::sqrt(1.0 / 30.0 + 1.0 / 10.0);
  const auto scale = file("figures/scale_main.dat");
  std::istringstream lines(scale);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (double value; cells >> value;) rows.back().push_back(value);
  }
  ASSERT_EQ(rows.size(), 4U) << scale;  // two of the line at 0
  for (const size_t i : {2U, 3U}) {
    const double value = (i == 2 ? 0.5 : -0.5) * apart;
    EXPECT_NEAR(rows[i].at(0), value, 1e-6);
    EXPECT_NEAR(rows[i].at(2), value - kNormal975 * error / 2.0, 1e-6);
    EXPECT_NEAR(rows[i].at(3), value + kNormal975 * error / 2.0, 1e-6);
  }
  EXPECT_THAT(file("figures/scale_main.gp"), HasSubstr("'fine' 2, 'coarse' 1"));
  // 1.0986, from 0.383 to 1.814, z 3.009: three of four prefer the upper.
  EXPECT_THAT(page, HasSubstr("fine</th><td>coarse</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">1.099</td><td class=\"num\">0.383 to 1.814</td>"
                              "<td class=\"num\">0.365</td><td class=\"num\">3.01</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">75.0 %</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">30/40</td>"));
  EXPECT_THAT(file("methods.txt"), HasSubstr("Bradley and Terry (1952)"));
  EXPECT_THAT(file("methods.txt"), HasSubstr("1.96 standard errors"));
}

TEST_F(StudyPageFitsTest, BootstrapOverObserversWhoAgreeHasNoWidth) {
  for (const char* code : {"a", "b", "c"})
    addHandMadeSession(store(), code, kPairProtocol, judgements(15, 20));
  const std::string page = writePage();
  // Whoever is drawn, the share is 3/4.
  const auto row = rowOf(file("tables/scales.csv"), "item", "fine");
  for (const char* column : {"estimate", "bootstrap_low", "bootstrap_high"})
    EXPECT_NEAR(std::stod(row.at(column)), 0.5 * std::log(3.0), 1e-6) << column;
  EXPECT_THAT(file("methods.txt"), HasSubstr("bootstrap over observers (2000 samples, seed 1)"));
  EXPECT_THAT(file("methods.txt"), HasSubstr("No other result on this page rests on random numbers."));
}

TEST_F(StudyPageFitsTest, ItemsThatAlwaysWinHaveNoScale) {
  addHandMadeSession(store(), "a", kPairProtocol, judgements(20, 20));
  const std::string page = writePage();
  EXPECT_THAT(page, HasSubstr("Part main has no scale: "));
  EXPECT_THAT(file("methods.txt"), Not(HasSubstr("Bradley")));
}

}  // namespace
}  // namespace limen::analysis
