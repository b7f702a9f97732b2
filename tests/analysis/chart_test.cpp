// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

struct DrawnMark {
  std::string key;
  double x, y;
};

// What stands after each `before` up to the next `end`.
std::vector<std::string> cutAll(const std::string& text, const std::string& before, char end) {
  std::vector<std::string> out;
  for (size_t at = 0; (at = text.find(before, at)) != std::string::npos;) {
    at += before.size();
    out.push_back(text.substr(at, text.find(end, at) - at));
  }
  return out;
}

// Keys of the marks and the places where gnuplot put them.
std::vector<DrawnMark> marksOf(const std::string& svg) {
  std::vector<DrawnMark> out;
  for (const std::string& rest : cutAll(svg, "data-run=\"", '\n')) {
    const std::vector<std::string> places = cutAll(rest, "translate(", ')');
    if (places.empty()) continue;
    const size_t comma = places[0].find(',');
    out.push_back(
        {rest.substr(0, rest.find('"')), std::stod(places[0]), std::stod(places[0].substr(comma + 1))});
  }
  return out;
}

TEST(Chart, EveryMarkCarriesItsDataAndStandsWhereItsLogarithmSays) {
  const TemporaryFolder folder;
  Chart chart{"speed_1", "title", "time (ms)", "RMSE", false, {}, {}};
  // Series 1 has no marks here, as happens when a technique cannot run in a scene.
  const std::vector<std::pair<double, double>> places = {
      {0.1, 1.0}, {1.0, 0.1}, {10.0, 0.01}, {100.0, 0.001}};
  for (size_t i = 0; i < places.size(); ++i)
    chart.marks.push_back({places[i].first, places[i].second, std::nullopt, i % 2 == 0 ? 0U : 2U, true, 0,
                           "run" + std::to_string(i), "label", "hover"});
  chart.front = {0, 1, 2, 3};
  std::vector<double> xs, ys;
  for (const auto& [x, y] : places) {
    xs.push_back(x);
    ys.push_back(y);
  }
  const std::string svg =
      drawChart(chart, makeChartAxis(xs, false), makeChartAxis(ys, false), 3, folder.path());
  std::map<std::string, DrawnMark> drawn;
  for (const DrawnMark& mark : marksOf(svg)) drawn[mark.key] = mark;
  ASSERT_EQ(drawn.size(), 4U);
  // Equal ratios are equal distances; right is more time, down (larger y in SVG) is less error.
  for (int i = 1; i < 3; ++i) {
    const DrawnMark &a = drawn["run" + std::to_string(i - 1)], &b = drawn["run" + std::to_string(i)],
                    &c = drawn["run" + std::to_string(i + 1)];
    EXPECT_NEAR(b.x - a.x, c.x - b.x, 0.05);
    EXPECT_NEAR(b.y - a.y, c.y - b.y, 0.05);
    EXPECT_GT(b.x, a.x);
    EXPECT_GT(b.y, a.y);
  }
  EXPECT_THAT(
      svg, HasSubstr("data-series=\"2\" data-run=\"run1\" data-label=\"label\" data-x=\"1\" data-y=\"0.1\""));
  for (const char* file : {"speed_1.gp", "speed_1.dat", "speed_1.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder.path(file))) << file;
}

TEST(Chart, IdsOfTwoChartsInOnePageDiffer) {
  const TemporaryFolder folder;
  std::set<std::string> ids;
  for (const char* name : {"speed_1", "speed_2"}) {
    Chart chart{name, "title", "x", "y", false, {{1, 1, std::nullopt, 0, true, 1, "k", "l", "h"}}, {0}};
    const std::string svg =
        drawChart(chart, makeChartAxis({1}, false), makeChartAxis({1}, false), 1, folder.path());
    for (const char quote : {'\'', '"'})
      for (const std::string& id : cutAll(svg, std::string(" id=") + quote, quote))
        EXPECT_TRUE(ids.insert(id).second) << id;
    EXPECT_GT(ids.size(), 5U);
    EXPECT_THAT(svg, Not(HasSubstr("<title>")));
  }
}

TEST(Chart, TextOfAUserCannotLeaveItsQuotes) {
  const TemporaryFolder folder;
  const std::string nasty =
      "it's `touch hacked` \"$(touch hacked)\" @x {/*9 big}\n system('touch hacked') größer <b>";
  Chart chart{"speed_1", nasty, nasty, nasty, false, {{1, 1, std::nullopt, 0, true, 1, nasty, nasty, nasty}},
              {0}};
  const std::string svg =
      drawChart(chart, makeChartAxis({1}, false), makeChartAxis({1}, false), 1, folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.path("hacked")));
  EXPECT_THAT(svg, Not(HasSubstr("<b>")));
  EXPECT_THAT(svg, HasSubstr("{/*9 big}"));
}

TEST(ChartAxis, ZeroStandsAtTheFootBelowAllOthers) {
  const ChartAxis axis = makeChartAxis({0.0, 0.01, 1.0}, false);
  ASSERT_TRUE(axis.foot);
  EXPECT_LT(*axis.foot, 0.01);
  EXPECT_GT(*axis.foot, axis.low);
  EXPECT_EQ(axis.place(0.0), *axis.foot);
  EXPECT_TRUE(axis.isAtFoot(0.0));
  EXPECT_FALSE(axis.isAtFoot(0.01));
  EXPECT_EQ(axis.ticks.back().first, "0");
  EXPECT_FALSE(makeChartAxis({0.01, 1.0}, false).foot);
}

TEST(ChartAxis, HoldsAllValuesAndShowsAtLeastTwoNumbers) {
  for (const std::vector<double>& values :
       {std::vector<double>{1.0}, {0.0}, {1.0, 1.0001}, {3.0, 4.5}, {1e-9, 1e9}, {}, {0.3, 0.8}}) {
    const ChartAxis axis = makeChartAxis(values, false);
    for (const double value : values) {
      EXPECT_GT(axis.place(value), axis.low);
      EXPECT_LT(axis.place(value), axis.high);
    }
    EXPECT_GE(axis.ticks.size(), 2U);
    EXPECT_LE(axis.ticks.size(), 12U);
    for (const auto& [label, value] : axis.ticks) {
      EXPECT_GE(value, axis.low);
      EXPECT_LE(value, axis.high);
    }
  }
}

TEST(Marker, TwoSeriesNeverLookTheSame) {
  std::set<std::string> looks;
  for (size_t series = 0; series < 49; ++series)
    EXPECT_TRUE(looks.insert(markerSvg(series)).second) << series;
}

}  // namespace
}  // namespace limen::analysis
