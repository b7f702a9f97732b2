// SPDX-License-Identifier: BSD-3-Clause
// The page of a study as a browser shows it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "analysis/output/text_output.h"
#include "analysis/study_page/study_page.h"
#include "experiments/base/image.h"
#include "tests/analysis/browser.h"
#include "tests/analysis/study/hand_made.h"

namespace limen::analysis {
namespace {

const char* const kStudyProbe = R"js(<script>
(() => {
  const all = (s, r = document) => [...r.querySelectorAll(s)], out = {};
  out.sections = all("section").map(s => s.id);
  const boxes = all("figure svg.chart").map(s => s.getBoundingClientRect());
  out.figures = boxes.length;
  out.drawn = boxes.filter(b => b.width > 150 && b.height > 100).length;
  out.captions = all("figure figcaption").filter(c => c.textContent.length > 40).length;
  out.spoken = all("figure svg").filter(s => s.getAttribute("aria-label")).length;
  out.rowHeads = all("main table tbody tr").filter(r => r.cells.length && r.cells[0].tagName === "TH").length
    === all("main table tbody tr").length;
  const ids = all("[id]").map(e => e.id);
  out.duplicateIds = ids.filter((id, i) => ids.indexOf(id) !== i);
  out.scripts = all("script").filter(s => !s.textContent.includes("probe") && !s.textContent.includes("problems")).length;
  out.sideways = document.documentElement.scrollWidth > innerWidth;
  // A telephone: lengths that depend on the window's width stay, so that the margin is set as it would be.
  document.documentElement.style.width = "400px";
  document.querySelector("main").style.padding = "0.8rem";
  document.body.getBoundingClientRect();
  out.narrow = all("main *").filter(e => !e.closest(".scroll") && !e.closest("svg") && !e.closest("pre")
    && e.getBoundingClientRect().right > 401).map(e => e.tagName + " " + e.textContent.slice(0, 40));
  out.smallest = Math.min(...all("figure svg.chart").map(s => s.getBoundingClientRect().width / s.viewBox.baseVal.width));
  out.problems = window.problems;
  const pre = document.createElement("pre");
  pre.id = "probe"; pre.textContent = JSON.stringify(out);
  document.body.append(pre);
})();
</script>)js";

/// Sixteen observers of two factors, with severity and predictions.
std::string writeStudy(const TemporaryFolder& folder) {
  const std::string store = folder.path("s.sqlite");
  const std::string protocol =
      "question: From where on is a change not seen?\n"
      "task: {type: yes_no, question: \"Seen?\", severity: {question: \"How?\", labels: [hardly, visible, "
      "clearly]}}\n"
      "factors:\n  distance: [1, 2, 4, 8]\n  surroundings_of_the_object: [a_plain_grey_wall, "
      "leaves_in_the_wind]\n"
      "exclusions: {catch_rate_above: 0.25}\n";
  for (int observer = 0; observer < 16; ++observer) {
    std::vector<HandMadeTrial> shown;
    for (int d = 0; d < 4; ++d)
      for (const char* where : {"a_plain_grey_wall", "leaves_in_the_wind"}) {
        const std::map<std::string, std::string> condition = {{"distance", std::to_string(1 << d)},
                                                              {"surroundings_of_the_object", where}};
        std::vector<HandMadeTrial> own = trials(condition, std::max(0, 4 - d - (observer + d) % 2), 4);
        for (HandMadeTrial& trial : own)
          if (trial.outcome == 1) trial.severity = 3 - std::min(d, 2);
        own = own + trials(condition, observer == 15 ? 1 : 0, 1, false);
        for (HandMadeTrial& trial : own) trial.reactionTimeS = 0.4 + 0.07 * observer + 0.2 * d;
        shown = shown + own;
        if (observer == 0)
          addHandMadePrediction(store, handMadeHash(own.front()),
                                {{"rating", 4.0 - d + (where[0] == 'a' ? 0.2 : 0.0)},
                                 {"detection_probability", 0.9 - 0.2 * d},
                                 {"coverage_of_object", 0.3 / (1 + d)},
                                 {"max_de94", 12.0 - d},
                                 {"regions", {{{"rating", 4.0 - d}}}}});
      }
    addHandMadeSession(store, "participant_" + std::to_string(observer), protocol, shown);
  }
  return store;
}

TEST(StudyPage, ReadsWellOnWideAndNarrowScreens) {
  const std::string browser = findBrowser();
  if (browser.empty())
    GTEST_SKIP() << "no Chromium on this machine: install the package chromium to test the page";
  const TemporaryFolder folder;
  StudyPageOptions options;
  options.choice.store = writeStudy(folder);
  options.folder = folder.path("out");
  const StudyPageResult result = writeStudyPages(options).at(0);

  const std::string png = folder.path("page.png");
  drawPage(browser, folder, result.page, "1280,1600", png);
  const Image image = readImage(png);
  std::set<std::vector<int>> colours;
  for (int y = 0; y < image.height; y += 3)
    for (int x = 0; x < image.width; x += 3) {
      std::vector<int> colour;
      for (int c = 0; c < 3; ++c) colour.push_back(static_cast<int>(255.0F * image.at(x, y, c)));
      colours.insert(colour);
    }
  EXPECT_GT(colours.size(), 50U) << "a page that is not drawn has one colour";

  const nlohmann::json found = probe(browser, folder, result.page, kStudyProbe, "1280,1600");
  EXPECT_EQ(found.at("problems"), nlohmann::json::array());
  EXPECT_EQ(found.at("duplicateIds"), nlohmann::json::array());
  EXPECT_EQ(found.at("sections"),
            nlohmann::json({"exclusions", "rates", "anova", "sensitivity", "psychometric", "validation",
                            "answers", "methods", "data"}));
  EXPECT_EQ(found.at("figures"), result.figures);
  EXPECT_EQ(found.at("drawn"), result.figures);
  EXPECT_EQ(found.at("captions"), result.figures);
  EXPECT_EQ(found.at("spoken"), result.figures);
  EXPECT_EQ(found.at("rowHeads"), true);
  EXPECT_EQ(found.at("scripts"), 0) << "works without JavaScript";
  EXPECT_EQ(found.at("sideways"), false);
  EXPECT_EQ(found.at("narrow"), nlohmann::json::array());
  EXPECT_GT(found.at("smallest").get<double>(), 0.75) << "letters of 13 px stay above 9.75";
}

}  // namespace
}  // namespace limen::analysis
