// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output/text_output.h"
#include "analysis/study_page/study_page.h"
#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {

/// Rating that the hand-made predictions give a condition, by which its answers go too.
double ratingOf(const std::string& distance, bool dynamic);

struct AnswerRow {
  std::string observer, distance, presentation;
  bool change = true;
  int outcome = 0;
};

/// A store of a study, and the pages made of it.
class StudyPages : public testing::Test {
 protected:
  std::string store() const { return folder_.path("s.sqlite"); }
  std::string file(const std::string& name) const { return readFileBytes(folder_.path("out/" + name)); }
  StudyPageOptions pageOptions() const {
    StudyPageOptions options;
    options.choice.store = store();
    options.folder = folder_.path("out");
    return options;
  }
  std::string writePage() const { return readFileBytes(writeStudyPages(pageOptions()).at(0).page); }

  TemporaryFolder folder_;
};

/// Four observers and one who guesses, in a study whose texts are hostile; what its page must say is worked
/// out from the store's rows.
class StudyPageTest : public StudyPages {
 protected:
  void addSession(size_t observer, const std::string& code, bool guesses = false,
                  const nlohmann::json& frontEnd = nlohmann::json::object());
  void addStudy(const nlohmann::json& frontEnd = nlohmann::json::object());
  void addPredictions();

  StudyPageOptions options() const;
  /// Writes the pages and gives the first.
  std::string write();

  /// Rows that count, of the observers who stay.
  std::vector<AnswerRow> rows() const;

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

  std::vector<StudyPageResult> results_;
  const std::vector<std::string> codes_ = {"a<b>&\"c", "p02", "p03", "p04"};
};

struct Moments {
  double mean = 0.0, sd = 0.0;
};
Moments momentsOf(const std::map<std::string, double>& values);

inline std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

}  // namespace limen::analysis
