// SPDX-License-Identifier: BSD-3-Clause
// The page of a study made by hand. What it must say is worked out here from the store's rows.
#include "analysis/study_page/study_page.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>
#include <set>
#include <sstream>

#include "analysis/output/text_output.h"
#include "tests/analysis/statistics/expect.h"
#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

// Quantile 0.975 of Student's t with 3 degrees of freedom, of the normal distribution (any table).
constexpr double kT3 = 3.182446305284263, kZ = 1.959963984540054;

const char* const kHostile = "<b>\"O'Neil\" & co</b>";
const std::string kPageProtocol = R"(title: unused
question: "Is <i>this</i> & \"that\" seen?"
task:
  type: yes_no
  question: "Seen a <change>?"
  answers: ["yes", "no"]
  severity: {question: "How <much>?", labels: [hardly, "<u>so</u>", clearly]}
factors:
  distance: [1, 2, 4]
  presentation: [dynamic, static]
order: {kind: shuffle}
blocks: {by: presentation, order: [dynamic, static]}
practice: {trials: 2, feedback: true}
exclusions: {catch_rate_above: 0.25, reaction_time_below_s: 0.15, blinks_above: 7}
form:
  - {name: age, label: Your age, choices: [young, old]}
)";

const std::string kPageDisplay =
    "name: desk\nresolution_px: [1600, 1200]\nsize_m: [0.4064, 0.3048]\ndistance_m: 0.6\nblack_cd_m2: 0.5\n"
    "peak_cd_m2: 250\ntransfer: srgb\nrefresh_hz: 60\n";

double ratingOf(const std::string& distance, bool dynamic) {
  return 4.0 - std::log2(std::stod(distance)) - (dynamic ? 0.75 : 0.0);
}

/// Answers of one observer: four trials with a change and two without in each condition.
std::vector<HandMadeTrial> answersOf(size_t observer, bool guesses) {
  std::vector<HandMadeTrial> out;
  size_t number = 0;
  for (const char* distance : {"1", "2", "4"})
    for (const bool dynamic : {true, false}) {
      const std::map<std::string, std::string> condition = {{"distance", distance},
                                                            {"presentation", dynamic ? "dynamic" : "static"}};
      // 2 to 4 of 4 when near, fewer when far or moving; observers differ.
      const int yes = std::clamp(
          static_cast<int>(ratingOf(distance, dynamic)) - static_cast<int>((observer + number) % 3) + 1, 0,
          4);
      std::vector<HandMadeTrial> own = trials(condition, yes, 4);
      for (HandMadeTrial& trial : own)
        if (trial.outcome == 1) trial.severity = 1 + static_cast<int>((observer + number) % 3);
      own = own + trials(condition, guesses ? 2 : (number == observer ? 1 : 0), 2, false);
      for (HandMadeTrial& trial : own) {
        trial.presentation = dynamic ? "dynamic" : "static";
        trial.reactionTimeS = 0.5 + 0.1 * static_cast<double>(number) + 0.05 * static_cast<double>(observer);
      }
      out = out + own;
      ++number;
    }
  return out;
}

struct AnswerRow {
  std::string observer, distance, presentation;
  bool change = true;
  int outcome = 0;
};

class StudyPageTest : public testing::Test {
 protected:
  void addSession(size_t observer, const std::string& code, bool guesses = false,
                  const nlohmann::json& frontEnd = nlohmann::json::object()) {
    std::vector<HandMadeTrial> shown = answersOf(observer, guesses);
    if (observer == 0) {
      HandMadeTrial hasty = shown.front(), practice = shown.front(), late = shown.front();
      hasty.reactionTimeS = 0.05;
      practice.practice = true;
      late.valid = false;
      shown = shown + std::vector<HandMadeTrial>{hasty, practice, late};
    }
    addHandMadeSession(store(), code, kPageProtocol, shown, "finished", "1", frontEnd, kHostile,
                       kPageDisplay);
  }
  void addStudy(const nlohmann::json& frontEnd = nlohmann::json::object()) {
    for (size_t i = 0; i < 4; ++i) addSession(i, codes_[i], false, frontEnd);
    addSession(1, "guesser", true, frontEnd);
  }
  void addPredictions() {
    for (const char* distance : {"1", "2", "4"})
      for (const bool dynamic : {true, false}) {
        HandMadeTrial trial =
            trials({{"distance", distance}, {"presentation", dynamic ? "dynamic" : "static"}}, 1, 1)[0];
        trial.presentation = dynamic ? "dynamic" : "static";
        const double rating = ratingOf(distance, dynamic);
        addHandMadePrediction(store(), handMadeHash(trial),
                              {{"rating", rating},
                               {"detection_probability", 1.0 / (1.0 + std::exp(-(rating - 2.0)))},
                               {"coverage_of_object", 0.02 * rating},
                               {"max_de94", 10.0 - rating},
                               {"regions", {{{"rating", rating}}}}});
      }
  }

  std::string store() const { return folder_.path("s.sqlite"); }
  std::string file(const std::string& name) const { return readFileBytes(folder_.path("out/" + name)); }
  StudyPageOptions options() const {
    StudyPageOptions out;
    out.choice.store = store();
    out.folder = folder_.path("out");
    return out;
  }
  std::string write() {
    results_ = writeStudyPages(options());
    return readFileBytes(results_.at(0).page);
  }

  /// Rows that count, of the observers who stay.
  std::vector<AnswerRow> rows() const {
    std::vector<AnswerRow> out;
    for (const store::StudySession& session : store::readSessions(store()))
      for (const store::StudyTrial& trial : store::readTrials(store(), session.id)) {
        if (!trial.valid.value_or(false) || trial.practice || trial.superseded ||
            session.participant == "guesser")
          continue;
        if (trial.response->reactionTimeS < 0.15) continue;
        out.push_back({session.participant, trial.condition.at("distance"),
                       trial.condition.at("presentation"), trial.change, trial.response->outcome});
      }
    return out;
  }

  /// Each observer's own rate of yes in the rows that `fits`.
  template <class Fits>
  std::map<std::string, double> ratesOf(Fits fits) const {
    std::map<std::string, std::pair<double, double>> sums;
    for (const AnswerRow& row : rows())
      if (fits(row)) sums[row.observer].first += row.outcome, sums[row.observer].second += 1.0;
    std::map<std::string, double> out;
    for (const auto& [observer, sum] : sums) out[observer] = sum.first / sum.second;
    return out;
  }

  TemporaryFolder folder_;
  std::vector<StudyPageResult> results_;
  const std::vector<std::string> codes_ = {"a<b>&\"c", "p02", "p03", "p04"};
};

struct Moments {
  double mean = 0.0, sd = 0.0;
};
Moments momentsOf(const std::map<std::string, double>& values) {
  Moments out;
  for (const auto& [name, value] : values) out.mean += value / static_cast<double>(values.size());
  for (const auto& [name, value] : values) out.sd += (value - out.mean) * (value - out.mean);
  out.sd = std::sqrt(out.sd / static_cast<double>(values.size() - 1));
  return out;
}

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

std::set<std::string> linksOf(const std::string& page) {
  std::set<std::string> out;
  for (size_t at = 0; (at = page.find("href=\"", at)) != std::string::npos;) {
    at += 6;
    out.insert(page.substr(at, page.find('"', at) - at));
  }
  return out;
}

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

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
      const double half = kT3 * own.sd / 2.0;  // sqrt(4) observers
      EXPECT_EQ(drawn[i].at(4), std::stod(distance));
      EXPECT_NEAR(drawn[i].at(1), 100.0 * own.mean, 1e-9);
      EXPECT_NEAR(drawn[i].at(2), 100.0 * std::max(0.0, own.mean - half), 1e-6);
      EXPECT_NEAR(drawn[i].at(3), 100.0 * std::min(1.0, own.mean + half), 1e-6);
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
    EXPECT_THAT(page, HasSubstr(fmt::format("<td class=\"num\">4</td><td class=\"num\">{}{:.2f}</td>",
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
  EXPECT_THAT(page, HasSubstr(fmt::format(
                        "presentation</th><td class=\"num\">{:.3f}</td><td class=\"num\">1, 3</td>", t * t)));
  EXPECT_THAT(page, HasSubstr("Greenhouse"));
  const std::string csv = file("tables/comparisons.csv");
  std::istringstream lines(csv);
  size_t seen = 0;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (cells[0] != "main") continue;
    EXPECT_NEAR(std::stod(cells[7]), pairedT(cells[1], cells[2], cells[3]), 1e-6) << line;
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

TEST_F(StudyPageTest, SaysWhatTheDataAreAndWhatWasLeftOut) {
  addStudy();
  const std::string page = write();
  EXPECT_THAT(page, Not(HasSubstr("imulated observer")));
  EXPECT_THAT(page, HasSubstr("catch_rate_above"));
  EXPECT_THAT(page, HasSubstr("guesser</th><td>catch_rate_above</td><td class=\"num\">36</td><td>yes in 12 "
                              "of 12 catch trials</td>"));
  EXPECT_THAT(page, HasSubstr("<td>reaction_time_below_s</td><td class=\"num\">1</td>"));
  EXPECT_THAT(page, HasSubstr("no: this program does not know it"));
  // Nothing excluded: five observers, the guesser's rates among them.
  const Moments own = momentsOf(ratesOf([](const AnswerRow& row) { return !row.change; }));
  const double all = (4.0 * own.mean + 1.0) / 5.0;
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">5</td><td class=\"num\">" + percent(all)));
  EXPECT_THAT(page, HasSubstr("2026-01-31"));
  EXPECT_THAT(page, Not(HasSubstr("12:00"))) << "no time of day";

  StudyPageOptions everything = options();
  everything.choice.exclusions = false;
  const std::string other = readFileBytes(writeStudyPages(everything).at(0).page);
  EXPECT_THAT(other, HasSubstr("exclusion rules are not applied"));
  EXPECT_THAT(other, HasSubstr("no: --no-exclusions"));
}

TEST_F(StudyPageTest, SimulatedObserversAreNoPeople) {
  addStudy({{"simulated", true}, {"observer", {{"kind", "lapsing"}}}});
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("They say nothing about people."));
  EXPECT_THAT(page, HasSubstr("5 simulated observers (kind: lapsing), not of people"));
  EXPECT_TRUE(results_[0].simulated);
  EXPECT_THAT(page, Not(HasSubstr("2026-01-31"))) << "their clock is not the world's";
  EXPECT_THAT(page, Not(HasSubstr("took part")));
}

TEST_F(StudyPageTest, MethodsHoldWhatIsStored) {
  addStudy(
      {{"gpu", "Card X"}, {"opengl", "4.6"}, {"lab_ready", false}, {"lab_doubts", {"a timer paces <it>"}}});
  const std::string page = write();
  const std::string methods = file("methods.txt");
  // 600 mm away, 0.254 mm a pixel: 2 x 600 x tan(0.5 deg) / 0.254 = 41.23 pixels.
  for (const char* words :
       {"5 observers took part, in 5 sessions.",
        "“Your age” was not recorded.",
        "1600 × 1200 pixels",
        "40.6 cm × 30.5 cm",
        "60 Hz",
        "41.2 pixels per degree",
        "0.5 to 250 cd/m²",
        "How its profile was measured was not recorded.",
        "window of 1024 × 768 pixels",
        "rendered by gpu, OpenGL 4.6",
        "In 5 of 5 sessions",
        "distance (3 levels) and presentation (2 levels)",
        "asked “Seen a <change>?”",
        "“yes” and “no”",
        "After a yes they graded severity in 3 steps",
        "36 to 37 answers",
        "4 to 5 with a change in each of 6 conditions",
        "2 without one",
        "shuffled for each session, within blocks by presentation, in the order dynamic, static",
        "0 to 1 practice trials",
        "with feedback",
        "1 showing was disturbed",
        "more than 25.0 % of their trials without a change (1 observer, 36 answers)",
        "less than 0.15 s after the question (1 answer)",
        "what the rule blinks_above (7) names was declared and not applied (this program does not know it)",
        "144 answers of 4 observers remain.",
        "Greenhouse and Geisser",
        "after Holm",
        "Hautus 1995",
        "Ceres ",
        "Boost ",
        "SQLite "})
    EXPECT_THAT(methods, HasSubstr(words));
  EXPECT_THAT(page, HasSubstr("5 of 5 sessions began although the machine&#39;s timing was not ready for a "
                              "laboratory: a timer paces &lt;it&gt;."));
}

TEST_F(StudyPageTest, HostileTextsStayTexts) {
  addStudy();
  addPredictions();
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("<h1>&lt;b&gt;&quot;O&#39;Neil&quot; &amp; co&lt;/b&gt;</h1>"));
  for (const char* raw : {"<b>\"", "<i>this", "<change>", "<u>so", "a<b>", "<much>"})
    EXPECT_THAT(page, Not(HasSubstr(raw)));
  EXPECT_THAT(page, HasSubstr("a&lt;b&gt;&amp;&quot;c"));
  // In a figure, gnuplot writes the participant's code into XML.
  EXPECT_THAT(file("figures/d_prime_main.svg"), HasSubstr("<text>a&lt;b>&amp;\"c</text>"));
}

TEST_F(StudyPageTest, FilesAreWholeAndLinksLeadSomewhere) {
  addStudy();
  addPredictions();
  const std::string page = write();
  size_t figures = 0;
  for (const std::string& link : linksOf(page)) {
    if (link[0] == '#') continue;
    EXPECT_TRUE(std::filesystem::exists(folder_.path("out/" + link))) << link;
  }
  const bool lint = std::system("command -v xmllint >/dev/null 2>&1") == 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path("out/figures"))) {
    const std::string bytes = readFileBytes(entry.path().string());
    if (entry.path().extension() == ".pdf") {
      ++figures;
      EXPECT_EQ(bytes.substr(0, 4), "%PDF") << entry.path();
      EXPECT_THAT(bytes.substr(bytes.size() - 16), HasSubstr("%%EOF"));
    }
    if (entry.path().extension() == ".svg") {
      EXPECT_THAT(bytes, HasSubstr("</svg>"));
      if (lint) {
        EXPECT_EQ(std::system(("xmllint --noout '" + entry.path().string() + "' 2>/dev/null").c_str()), 0)
            << entry.path();
      }
    }
  }
  EXPECT_EQ(figures, results_[0].figures);
  EXPECT_GE(figures, 9U);
  const std::regex noNumber("\\b(nan|inf|infinity|undefined)\\b", std::regex::icase);
  std::string text = page;
  for (size_t at; (at = text.find("<style>")) != std::string::npos;)
    text.erase(at, text.find("</style>", at) - at + 8);
  std::smatch found;
  EXPECT_FALSE(std::regex_search(text, found, noNumber))
      << found.prefix().str().substr(std::max<size_t>(found.prefix().length(), 80) - 80) << found.str();
  for (const char* table : {"rates", "anova", "comparisons", "sensitivity", "scenarios", "agreement",
                            "severity", "reaction_times", "left_out", "sessions"})
    EXPECT_GT(file(std::string("tables/") + table + ".csv").size(), 20U) << table;
}

TEST_F(StudyPageTest, AStudyOfEqualAnswersHasNoNumberThatIsNone) {
  // Everybody sees everything: no spread, F without a value, areas that do not exist.
  for (const char* code : {"p1", "p2"})
    addHandMadeSession(
        store(), code, "task: {type: yes_no}\nfactors:\n  d: [near, far]\n",
        trials({{"d", "near"}}, 2, 2) + trials({{"d", "far"}}, 2, 2) + trials({{"d", "far"}}, 0, 2, false));
  const std::string page = write();
  const std::regex noNumber("[>\\s](nan|-?inf)[<\\s]", std::regex::icase);
  EXPECT_FALSE(std::regex_search(page, noNumber));
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">100.0 %</td>"));
}

TEST_F(StudyPageTest, OneObserverHasNoIntervals) {
  addSession(1, "alone");
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("rates_main"));
  EXPECT_THAT(page, Not(HasSubstr("id=\"anova\"")));
  // Neither SD nor interval over observers.
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">–</td><td class=\"num\">–</td>"));
}

TEST_F(StudyPageTest, SeveralProtocolsHaveFoldersOfTheirOwn) {
  addStudy();
  addHandMadeSession(store(), "other", "task: {type: yes_no}\nfactors:\n  d: [near, far]\n",
                     trials({{"d", "near"}}, 1, 2) + trials({{"d", "far"}}, 1, 2));
  write();
  ASSERT_EQ(results_.size(), 2U);
  EXPECT_NE(results_[0].page, results_[1].page);
  for (const StudyPageResult& result : results_) {
    EXPECT_TRUE(std::filesystem::exists(result.page)) << result.page;
    EXPECT_NE(std::filesystem::path(result.page).parent_path(), folder_.path("out"));
  }
  StudyPageOptions one = options();
  one.choice.protocol = results_[1].hash;
  one.folder = folder_.path("one");
  EXPECT_EQ(writeStudyPages(one).at(0).page, folder_.path("one/report.html"));
}

TEST_F(StudyPageTest, AnErrorLeavesNothingBehind) {
  { const store::Store empty(store(), store::Access::ReadWrite); }
  expectError([&] { write(); }, "holds no sessions");
  addStudy();
  StudyPageOptions wrong = options();
  wrong.choice.protocol = "hand_mad";
  expectError([&] { writeStudyPages(wrong); }, "hand_made");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));

  // gnuplot is not there: the page that was written before stays as it was.
  const std::string before = write();
  std::filesystem::remove(folder_.path("out/figures/rates_main.svg"));
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.path("empty").c_str(), 1);
  expectError([&] { write(); }, "gnuplot-nox");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(file("report.html"), before);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out/figures/rates_main.svg")));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("part-")));
  expectError(
      [&] {
        StudyPageOptions nowhere = options();
        nowhere.folder = "/proc/nowhere";
        writeStudyPages(nowhere);
      },
      "/proc/nowhere");
}

}  // namespace
}  // namespace limen::analysis
