// SPDX-License-Identifier: BSD-3-Clause
// Numbers on the page of a study made by hand.
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "analysis/answer_tables/table.h"
#include "tests/analysis/study/study_page_fixture.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;

// Quantile 0.975 of Student's t with 3 degrees of freedom, of the normal distribution (any table).
constexpr double kT3 = 3.182446305284263, kZ = 1.959963984540054;

/// Blocks of a figure's data: the words above each, and its rows.
std::vector<std::pair<std::string, std::vector<std::vector<double>>>> blocksOf(const std::string& text) {
  std::vector<std::pair<std::string, std::vector<std::vector<double>>>> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line[0] == '#') {
      out.push_back({line, {}});
      continue;
    }
    std::istringstream cells(line);
    out.back().second.emplace_back();
    for (double value; cells >> value;) out.back().second.back().push_back(value);
  }
  return out;
}

std::vector<std::vector<double>> blockWith(const std::string& text, const std::string& words) {
  for (const auto& [heading, rows] : blocksOf(text))
    if (heading.find(words) != std::string::npos) return rows;
  ADD_FAILURE() << "no block " << words << " in " << text;
  return {};
}

/// Inverse of the normal distribution function, by halving.
double normalQuantile(double p) {
  double low = -10.0, high = 10.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return low;
}

TEST_F(StudyPageTest, RatesAreThoseOfTheRows) {
  addStudy();
  const std::string page = write();
  EXPECT_EQ(results_[0].observers, 4U);
  EXPECT_EQ(results_[0].sessions, 5U);
  EXPECT_EQ(results_[0].answers, rows().size());
  const std::string data = file("figures/rates_main.dat");
  for (const std::string presentation : {"dynamic", "static"}) {
    const auto drawn = blockWith(data, "# " + presentation + ":");
    ASSERT_EQ(drawn.size(), 3U);
    for (size_t i = 0; i < 3; ++i) {
      const std::string distance = std::vector<std::string>{"1", "2", "4"}[i];
      const Moments own = momentsOf(ratesOf([&](const AnswerRow& row) {
        return row.change && row.distance == distance && row.presentation == presentation;
      }));
      // t over 4 observers on the logit scale.
      const double logit = std::log(own.mean / (1.0 - own.mean)),
                   reach = kT3 * own.sd / 2.0 / (own.mean * (1.0 - own.mean));
      EXPECT_EQ(drawn[i].at(4), std::stod(distance));
      EXPECT_NEAR(drawn[i].at(1), 100.0 * own.mean, 1e-9);
      EXPECT_NEAR(drawn[i].at(2), 100.0 / (1.0 + std::exp(reach - logit)), 1e-6);
      EXPECT_NEAR(drawn[i].at(3), 100.0 / (1.0 + std::exp(-reach - logit)), 1e-6);
      // Beside their own place, nearer to it than to any other.
      EXPECT_NEAR(std::log2(drawn[i].at(0)), std::log2(drawn[i].at(4)), 0.5);
      EXPECT_THAT(page, HasSubstr("<td class=\"num\">" + percent(own.mean) + "</td>"));
    }
  }
  const Moments catches = momentsOf(ratesOf([](const AnswerRow& row) { return !row.change; }));
  EXPECT_NEAR(blockWith(data, "no change").front().at(1), 100.0 * catches.mean, 1e-9);
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">" + percent(catches.mean) + "</td><td class=\"num\">" +
                              percent(catches.sd) + "</td>"));
}

TEST_F(StudyPageTest, SensitivityIsThatOfTheRows) {
  addStudy();
  const std::string page = write();
  std::map<std::string, double> dPrimes, criteria;
  for (const std::string& code : codes_) {
    double hits = 0.0, signals = 0.0, alarms = 0.0, noises = 0.0;
    for (const AnswerRow& row : rows()) {
      if (row.observer != code) continue;
      (row.change ? hits : alarms) += row.outcome;
      (row.change ? signals : noises) += 1.0;
    }
    const double zHit = normalQuantile((hits + 0.5) / (signals + 1.0)),
                 zAlarm = normalQuantile((alarms + 0.5) / (noises + 1.0));
    dPrimes[code] = zHit - zAlarm;
    criteria[code] = -0.5 * (zHit + zAlarm);
  }
  for (const auto& [name, values] :
       {std::pair{std::string("d_prime"), dPrimes}, {std::string("criterion"), criteria}}) {
    std::vector<double> sorted;
    for (const auto& [code, value] : values) sorted.push_back(value);
    std::sort(sorted.begin(), sorted.end());
    const std::string data = file("figures/" + name + "_main.dat");
    const auto dots = blockWith(data, "place, value");
    ASSERT_EQ(dots.size(), 4U);
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(dots[i].at(1), sorted[i], 1e-9) << name;
    const Moments own = momentsOf(values);
    EXPECT_NEAR(blockWith(data, "mean over observers").front().at(1), own.mean, 1e-9);
    EXPECT_NEAR(blockWith(data, "interval of the mean").front().at(1), own.mean - kT3 * own.sd / 2.0, 1e-6);
    EXPECT_THAT(page, HasSubstr(fmt::format("<td class=\"num\">4</td><td class=\"num\">{}{:.3f}</td>",
                                            own.mean < 0.0 ? "−" : "", std::abs(own.mean))));
  }
}

TEST_F(StudyPageTest, VarianceAndPairsAreThoseOfTheRows) {
  addStudy();
  const std::string page = write();
  // A factor of two levels: F is the square of the paired t over observers.
  const auto meanOf = [&](const std::string& factor, const std::string& level) {
    // Cells have equal numbers of answers, so that means of answers are means of cells.
    return ratesOf([&](const AnswerRow& row) {
      return row.change && (factor == "distance" ? row.distance : row.presentation) == level;
    });
  };
  const auto pairedT = [&](const std::string& factor, const std::string& first, const std::string& second) {
    std::map<std::string, double> differences = meanOf(factor, first);
    for (const auto& [code, rate] : meanOf(factor, second)) differences[code] -= rate;
    const Moments own = momentsOf(differences);
    return own.mean / (own.sd / 2.0);
  };
  const double t = pairedT("presentation", "dynamic", "static");
  EXPECT_THAT(
      page,
      HasSubstr(fmt::format(
          "presentation</th><td class=\"num\">{:.3f}</td><td class=\"num\">1</td><td class=\"num\">3</td>",
          t * t)));
  EXPECT_THAT(page, HasSubstr("Greenhouse"));
  const Table csv = Table::parse(file("tables/anova.csv"), "anova.csv");
  const auto cell = [&](size_t row, const char* column) { return csv.text(row, csv.column(column)); };
  size_t seen = 0;
  for (size_t row = 0; row < csv.rows(); ++row) {
    if (cell(row, "table") != "pairs") continue;
    EXPECT_EQ(cell(row, "part"), "main");
    EXPECT_NEAR(std::stod(cell(row, "t")),
                pairedT(cell(row, "factor"), cell(row, "first"), cell(row, "second")), 1e-6);
    ++seen;
  }
  EXPECT_EQ(seen, 3U + 1U) << "pairs of three distances and of two presentations";
}

TEST_F(StudyPageTest, PredictionsAreSetBesideTheRows) {
  addStudy();
  addPredictions();
  const std::string page = write();
  struct Sums {
    double rating = 0.0, yes = 0.0, trials = 0.0;
  };
  std::map<std::pair<std::string, std::string>, Sums> scenarios;
  for (const AnswerRow& row : rows()) {
    if (!row.change) continue;
    Sums& sums = scenarios[{row.presentation, row.distance}];
    sums.rating = ratingOf(row.distance, row.presentation == "dynamic");
    sums.yes += row.outcome;
    sums.trials += 1.0;
  }
  const std::string data = file("figures/rate_by_rating_main.dat");
  for (const std::string presentation : {"dynamic", "static"}) {
    const auto drawn = blockWith(data, "# " + presentation + ":");
    ASSERT_EQ(drawn.size(), 3U);
    for (size_t i = 0; i < 3; ++i) {
      const Sums& sums = scenarios.at({presentation, std::vector<std::string>{"1", "2", "4"}[i]});
      const double n = sums.trials, p = sums.yes / n, square = kZ * kZ;
      const double middle = (p + square / (2 * n)) / (1 + square / n);
      const double half = kZ * std::sqrt(p * (1 - p) / n + square / (4 * n * n)) / (1 + square / n);
      EXPECT_NEAR(drawn[i].at(0), sums.rating, 1e-12);
      EXPECT_NEAR(drawn[i].at(1), 100.0 * p, 1e-9);
      EXPECT_NEAR(drawn[i].at(2), 100.0 * (middle - half), 1e-6);
      EXPECT_NEAR(drawn[i].at(3), 100.0 * (middle + half), 1e-6);
    }
  }
  // Area by counting pairs of answers, and under the curve that is drawn.
  double above = 0.0, pairs = 0.0, area = 0.0;
  for (const auto& [a, yes] : scenarios)
    for (const auto& [b, no] : scenarios) {
      const double count = yes.yes * (no.trials - no.yes);
      pairs += count;
      above += count * (yes.rating > no.rating ? 1.0 : yes.rating == no.rating ? 0.5 : 0.0);
    }
  const auto roc = blockWith(file("figures/roc_main.dat"), "# rating:");
  for (size_t i = 0; i + 1 < roc.size(); ++i)
    area += (roc[i + 1][0] - roc[i][0]) * 0.5 * (roc[i + 1][1] + roc[i][1]) / 10'000.0;
  EXPECT_NEAR(area, above / pairs, 1e-9);
  EXPECT_THAT(page, HasSubstr(fmt::format("rating</th><td class=\"num\">{:.3f}</td>", area)));
  // Calibration: bins of a tenth.
  std::map<int, Sums> bins;
  for (const auto& [key, sums] : scenarios) {
    const double probability = 1.0 / (1.0 + std::exp(-(sums.rating - 2.0)));
    Sums& bin = bins[static_cast<int>(probability * 10.0)];
    bin.rating += probability * sums.trials;
    bin.yes += sums.yes;
    bin.trials += sums.trials;
  }
  const auto calibration = blockWith(file("figures/calibration_main.dat"), "mean prediction");
  ASSERT_EQ(calibration.size(), bins.size());
  size_t place = 0;
  for (const auto& [bin, sums] : bins) {
    EXPECT_NEAR(calibration[place].at(0), 100.0 * sums.rating / sums.trials, 1e-9);
    EXPECT_NEAR(calibration[place++].at(1), 100.0 * sums.yes / sums.trials, 1e-9);
  }
  // With all of the scenarios' pairs concordant or tied, tau_c is far above 0; a table has it, and the rules.
  EXPECT_THAT(page, HasSubstr("τ_c"));
  EXPECT_THAT(page, HasSubstr("Table 10.1"));
  EXPECT_THAT(page, HasSubstr("each scenario left out once"));
}

}  // namespace
}  // namespace limen::analysis
