// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/output/text_output.h"
#include "analysis/sweep/report.h"
#include "tests/analysis/browser.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;

// Uses the page as a reader would and writes what it finds into the page.
const char* const kProbe = R"js(<script>
(() => {
  const all = (s, r = document) => [...r.querySelectorAll(s)], out = {};
  const marks = () => all("#speed .mark"), shown = list => list.filter(m => m.getClientRects().length).length;
  out.marks = marks().length;
  out.keys = [...new Set(marks().map(m => m.dataset.run))].length;
  out.labelled = marks().filter(m => m.dataset.label && isFinite(m.dataset.x) && isFinite(m.dataset.y)
    && m.getAttribute("aria-label")).length;
  out.series = [...new Set(marks().map(m => m.dataset.series))].length;
  out.legend = all("#speed .legend button").length;
  out.panels = all("#speed .panel").length;
  out.shown = shown(marks());
  const ids = all("[id]").map(e => e.id);
  out.duplicateIds = ids.filter((id, i) => ids.indexOf(id) !== i);

  const mark = marks()[7], tip = document.getElementById("tip");
  out.tipBefore = tip.hidden;
  mark.dispatchEvent(new Event("pointerenter"));
  out.tip = tip.hidden ? "" : tip.textContent;
  out.markX = mark.dataset.x; out.markLabel = mark.dataset.label;
  mark.dispatchEvent(new Event("pointerleave"));
  out.tipAfter = tip.hidden;

  // Of the marks shown, those that no other beats.
  const frontIsRight = () => all("#speed .chart").every(chart => {
    const here = all(".mark:not(.is-off)", chart).map(m => ({ m, x: +m.dataset.x, y: +m.dataset.y }));
    return here.every(a => a.m.classList.contains("front") ===
      !here.some(b => b.x <= a.x && b.y <= a.y && (b.x < a.x || b.y < a.y)));
  });
  const lines = () => all("#speed .front-line path").map(p => p.getAttribute("d").replace(/\s+/g, " ").trim());
  const corners = d => d.match(/[\d.]+,[\d.]+/g).map(c => c.split(",").map(Number));
  const button = all("#speed .legend button")[1];
  out.frontBefore = frontIsRight();
  const linesBefore = lines();
  out.ofSeries = all('.mark[data-series="1"]').length;
  button.click();
  out.shownOfSeries = shown(all('.mark[data-series="1"]'));
  out.shownOthers = shown(all('.mark:not([data-series="1"])')) === all('.mark:not([data-series="1"])').length;
  out.pressed = all('.legend button[data-series="1"]').map(b => b.getAttribute("aria-pressed"));
  out.frontWithout = frontIsRight();
  out.lineMoved = lines().some((d, i) => d !== linesBefore[i]);
  out.listedWithout = shown(all('.front tr[data-series="1"]'));
  button.click();
  out.frontAfter = frontIsRight();
  out.lineEnds = lines().every((d, i) => {
    const now = corners(d), before = corners(linesBefore[i]);
    return Math.hypot(now[0][0] - before[0][0], now[0][1] - before[0][1]) < 0.1
      && Math.hypot(now.at(-1)[0] - before.at(-1)[0], now.at(-1)[1] - before.at(-1)[1]) < 0.1;
  });
  const legend = all("#passes .pass-legend li").slice(0, -1);
  out.passes = legend.length;
  out.passColours = new Set(legend.map(l => getComputedStyle(l.firstElementChild).backgroundColor)).size;
  out.colourBars = all(".colour-bar").length;
  const chart = document.querySelector("#speed .panels").getBoundingClientRect();
  out.usedWidth = all("#speed .panel").map(p => p.getBoundingClientRect().right).reduce((a, b) => Math.max(a, b)) / chart.right;
  const second = document.querySelector(".trio").querySelectorAll("figcaption")[1].textContent;
  out.besideProduct = second;
  out.shownAgain = shown(all('.mark[data-series="1"]'));

  const headings = all("#runs thead th"), column = headings.findIndex(h => h.textContent.startsWith("RMSE"));
  const values = () => all("#runs tbody tr").map(r => Number(r.cells[column].dataset.v));
  headings[column].querySelector("button").click();
  out.ascending = values(); out.sortName = headings[column].getAttribute("aria-sort");
  headings[column].querySelector("button").click();
  out.descending = values();
  out.rows = values().length;
  const counter = headings.findIndex(h => h.textContent.startsWith("Micro-occluders"));
  for (let press = 0; press < 2; ++press) {
    headings[counter].querySelector("button").click();
    const filled = all("#runs tbody tr").map(r => r.cells[counter].textContent !== "");
    out["emptyLast" + press] = filled.lastIndexOf(true) < filled.indexOf(false);
  }

  const lens = document.querySelector(".lens"), group = lens.closest(".picture-rows");
  const box = lens.getBoundingClientRect();
  out.lensWidth = box.width; out.pictureWidth = lens.querySelector("svg").viewBox.baseVal.width;
  lens.dispatchEvent(new PointerEvent("pointermove", {clientX: box.left + box.width / 2, clientY: box.top + box.height / 4}));
  out.enlarged = all(".lens svg", group).filter(s => s.style.transform === "scale(4)"
    && s.style.transformOrigin.startsWith("50% 25%")).length;
  out.pictures = all(".lens svg", group).length;
  out.brokenPictures = all(".lens svg").filter(s => !s.firstElementChild).length;
  out.sideways = document.documentElement.scrollWidth > innerWidth;
  out.problems = window.problems;
  const pre = document.createElement("pre");
  pre.id = "probe"; pre.textContent = JSON.stringify(out);
  document.body.append(pre);
})();
</script>)js";

/// One test of both windows: writing the report takes longest.
TEST(ReportPage, WorksInABrowserAndDoesNotScrollSidewaysOnAPhone) {
  const std::string browser = findBrowser();
  if (browser.empty())
    GTEST_SKIP() << "no Chromium on this machine: install the package chromium to test the page";
  const TemporaryFolder folder;
  const size_t runs = writeLargeExperiment(folder.path("s.sqlite"), true);
  const std::string page = writeReports({folder.path("s.sqlite"), folder.path("out"), "", false}).at(0).page;
  const std::string asWritten = readFileBytes(page);
  const nlohmann::json found = probe(browser, folder, page, kProbe, "1280,1600");

  EXPECT_EQ(found.at("problems"), nlohmann::json::array());
  EXPECT_EQ(found.at("duplicateIds"), nlohmann::json::array());
  EXPECT_EQ(found.at("marks"), runs);
  EXPECT_EQ(found.at("keys"), runs);
  EXPECT_EQ(found.at("labelled"), runs);
  EXPECT_EQ(found.at("shown"), runs);
  EXPECT_EQ(found.at("series"), 6);
  EXPECT_EQ(found.at("legend"), 6);
  EXPECT_EQ(found.at("panels"), 3);

  EXPECT_EQ(found.at("tipBefore"), true);
  const std::string tip = found.at("tip");
  EXPECT_THAT(tip, HasSubstr(found.at("markLabel").get<std::string>()));
  for (const char* part : {"Samples: ", "(ms): ", "RMSE: ", "["}) EXPECT_THAT(tip, HasSubstr(part));
  EXPECT_THAT(tip, HasSubstr(formatNumber(std::stod(found.at("markX").get<std::string>()))));
  EXPECT_EQ(found.at("tipAfter"), true);

  EXPECT_GT(found.at("ofSeries"), 0);
  EXPECT_EQ(found.at("shownOfSeries"), 0) << "hidden in all panels";
  EXPECT_EQ(found.at("shownOthers"), true);
  for (const nlohmann::json& pressed : found.at("pressed")) EXPECT_EQ(pressed, "false");
  EXPECT_EQ(found.at("shownAgain"), found.at("ofSeries"));
  EXPECT_EQ(found.at("frontBefore"), true);
  EXPECT_EQ(found.at("frontWithout"), true) << "the front is that of the marks that are shown";
  EXPECT_EQ(found.at("lineMoved"), true);
  EXPECT_EQ(found.at("listedWithout"), 0);
  EXPECT_EQ(found.at("frontAfter"), true);
  EXPECT_EQ(found.at("lineEnds"), true);
  EXPECT_EQ(found.at("passes"), 3);
  EXPECT_EQ(found.at("passColours"), 3);
  EXPECT_EQ(found.at("colourBars"), 6 * 3 * 3) << "one below each error map";
  EXPECT_GT(found.at("usedWidth"), 0.99);
  EXPECT_EQ(found.at("besideProduct"), "reference");

  const std::vector<double> ascending = found.at("ascending"), descending = found.at("descending");
  EXPECT_EQ(found.at("rows"), runs);
  EXPECT_TRUE(std::is_sorted(ascending.begin(), ascending.end()));
  EXPECT_TRUE(std::is_sorted(descending.rbegin(), descending.rend()));
  EXPECT_LT(ascending.front(), ascending.back());
  EXPECT_EQ(found.at("sortName"), "ascending");
  EXPECT_EQ(found.at("emptyLast0"), true);
  EXPECT_EQ(found.at("emptyLast1"), true);

  EXPECT_EQ(found.at("enlarged"), found.at("pictures"));
  EXPECT_EQ(found.at("pictures"), 6 * 3 * 3) << "six techniques, three settings, three pictures";
  EXPECT_EQ(found.at("lensWidth"), found.at("pictureWidth")) << "a picture is not scaled";
  EXPECT_EQ(found.at("brokenPictures"), 0);
  EXPECT_EQ(found.at("sideways"), false);

  writeFileBytes(page, asWritten);
  const nlohmann::json onPhone = probe(browser, folder, page, kProbe, "500,900");
  EXPECT_EQ(onPhone.at("problems"), nlohmann::json::array());
  EXPECT_EQ(onPhone.at("sideways"), false);
}

}  // namespace
}  // namespace limen::analysis
