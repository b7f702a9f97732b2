// SPDX-License-Identifier: BSD-3-Clause
// The files of a study's page, and studies of which there is little to say.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>

#include "tests/analysis/statistics/expect.h"
#include "tests/analysis/study/study_page_fixture.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

std::set<std::string> linksOf(const std::string& page) {
  std::set<std::string> out;
  for (size_t at = 0; (at = page.find("href=\"", at)) != std::string::npos;) {
    at += 6;
    out.insert(page.substr(at, page.find('"', at) - at));
  }
  return out;
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
  for (const char* table : {"rates", "anova", "sensitivity", "validation", "severity_main",
                            "reaction_times_main", "left_out", "sessions"})
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
