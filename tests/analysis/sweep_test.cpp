// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::ElementsAre;

class SweepTest : public testing::Test {
 protected:
  Sweep load(std::vector<store::Run> runs, const nlohmann::json& report = nlohmann::json::object(),
             const std::vector<store::PlanEntry>& missing = {},
             const store::Descriptions& descriptions = {}) {
    store::Experiment experiment;
    experiment.title = "t";
    experiment.hash = "t" + report.dump();
    experiment.report = report;
    const int64_t id = writeExperiment(store_, experiment, std::move(runs), missing,
                                       {"Test GPU", false, nlohmann::json::object()}, descriptions);
    for (const store::Experiment& one : store_.experiments())
      if (one.id == id) return loadSweep(store_, one);
    ADD_FAILURE();
    return {};
  }

  TemporaryFolder folder_;
  store::Store store_{folder_.path("s.sqlite"), store::Access::ReadWrite};
};

std::vector<std::string> columnsOf(const Sweep& sweep) {
  std::vector<std::string> names;
  for (const Axis& column : sweep.varyingColumns) names.push_back(column.name);
  return names;
}

TEST_F(SweepTest, TheFrontOfAPanelHoldsWhatNothingBeats) {
  // b is slower and worse than a; c is slower but better; another scene is another panel.
  const Sweep sweep = load({makeRun("x/a", "s", 1, {1, 1, 1}, 0.5), makeRun("x/b", "s", 1, {2, 2, 2}, 0.6),
                            makeRun("x/c", "s", 1, {3, 3, 3}, 0.1), makeRun("x/b", "r", 1, {9, 9, 9}, 0.9)});
  ASSERT_EQ(sweep.panels.size(), 2U);
  EXPECT_EQ(sweep.panels[0].title, "s");
  EXPECT_THAT(sweep.panels[0].front, ElementsAre(0, 2));
  EXPECT_THAT(sweep.panels[1].front, ElementsAre(3));
  EXPECT_EQ(sweep.cells[2].frontNumber, 2);
  EXPECT_EQ(sweep.cells[1].frontNumber, 0);
  EXPECT_THAT(sweep.series, ElementsAre("a", "b", "c"));
  EXPECT_EQ(sweep.seriesPrefix, "x/");
  EXPECT_EQ(sweep.label(sweep.cells[2]), "c, samples=1");
}

TEST_F(SweepTest, TimesAreMediansOfFramesWithIntervalsByRounds) {
  const Sweep sweep = load({makeRun("a", "s", 1, {1, 1, 1, 2, 2, 2, 3, 3, 3}, 0.5)});
  const Cell& cell = sweep.cells.at(0);
  EXPECT_EQ(cell.x, 2.0);
  EXPECT_EQ(cell.frame->median, 2.0);
  EXPECT_EQ(cell.frame->n, 9U);
  EXPECT_TRUE(cell.interval->byRounds);
  EXPECT_EQ(cell.interval->low, 1.0);
  EXPECT_EQ(cell.interval->high, 3.0);
}

TEST_F(SweepTest, APeakSignalToNoiseRatioIsBetterWhenHigher) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0), makeRun("b", "s", 1, {2}, 0),
                                  makeRun("c", "s", 1, {3}, 0)};
  const double psnr[] = {30, 20, 40};
  for (size_t i = 0; i < 3; ++i) runs[i].measurements.push_back({"psnr", psnr[i], "dB", "error"});
  EXPECT_THAT(load(runs, {{"x", "gpu_ms"}, {"y", "psnr"}}).panels[0].front, ElementsAre(0, 2));
}

TEST_F(SweepTest, ASceneThatVariesGivesAPanelForEachOfItsSettings) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1), makeRun("a", "s", 2, {1}, 0.2)};
  runs[1].parameters["scene"]["size"] = 2.5;
  const Sweep sweep = load(runs);
  ASSERT_EQ(sweep.panels.size(), 2U);
  EXPECT_EQ(sweep.panels[1].title, "s, size 2.5");
  EXPECT_THAT(columnsOf(sweep), ElementsAre("samples", "size"));
  EXPECT_EQ(sweep.cells[1].varying.at("samples"), "2");
  EXPECT_EQ(sweep.cells[1].varying.count("bias"), 0U) << "what does not vary is no column";
}

TEST_F(SweepTest, PanelsAndSeriesCanBeParametersAndAnAxisToo) {
  const Sweep sweep = load({makeRun("a", "s", 1, {1}, 0.1), makeRun("a", "s", 4, {1}, 0.2)},
                           {{"x", "samples"}, {"y", "rmse"}, {"series", "samples"}, {"panels", "technique"}});
  EXPECT_THAT(sweep.series, ElementsAre("samples 1", "samples 4"));
  EXPECT_EQ(sweep.panels.at(0).title, "a");
  EXPECT_EQ(sweep.cells[1].x, 4.0);
}

TEST_F(SweepTest, MissingFailedAndUnfinishedRunsAreCounted) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1), makeRun("b", "s", 1, {1}, 0.1)};
  runs[1].status = "failed";
  runs[1].error = "non-finite values";
  const store::Run claimed = makeRun("c", "s", 1, {1}, 0.1);
  store_.claim(claimed);
  const Sweep sweep = load(runs, {}, {{claimed.key, "c", "s", ""}, {"never started", "d", "s", ""}});
  EXPECT_EQ(sweep.planned, 4U);
  EXPECT_EQ(sweep.cells.size(), 1U);
  ASSERT_EQ(sweep.failed.size(), 1U);
  EXPECT_EQ(sweep.failed[0].error, "non-finite values");
  ASSERT_EQ(sweep.missing.size(), 2U);
  EXPECT_EQ(sweep.missing[0].technique, "c");
  EXPECT_FALSE(sweep.isComplete());
}

TEST_F(SweepTest, TimesOfTwoDevicesAreNotCompared) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1), makeRun("b", "s", 1, {5}, 0.2)};
  runs[1].device = "slow GPU";
  const Sweep sweep = load(runs);
  EXPECT_TRUE(sweep.severalDevices);
  ASSERT_EQ(sweep.panels.size(), 2U);
  EXPECT_EQ(sweep.panels[1].front.size(), 1U);
}

TEST_F(SweepTest, EachDeviceHasAVerdictOfItsOwn) {
  // Within ten times the time of the other's device, and with more error, yet the best of its own.
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1), makeRun("b", "s", 1, {10}, 0.2)};
  runs[1].device = "slow GPU";
  const Sweep sweep = load(runs);
  ASSERT_EQ(sweep.panels.size(), 2U);
  EXPECT_THAT(sweep.panels[1].verdict.worth, ElementsAre(1));
  EXPECT_FALSE(sweep.cells[1].beaten);
}

TEST_F(SweepTest, ATimeOfOneFrameHasNoIntervalAndIsTakenAsExact) {
  const Sweep sweep = load({makeRun("a", "s", 1, {1}, 0.1), makeRun("b", "s", 1, {2, 2}, 0.2)});
  EXPECT_FALSE(sweep.cells[0].interval);
  EXPECT_TRUE(sweep.cells[1].interval);
  EXPECT_TRUE(sweep.exactTimesTaken);
  EXPECT_FALSE(load({makeRun("c", "s", 1, {1, 1}, 0.1)}).exactTimesTaken);
}

TEST_F(SweepTest, TimesWhoseIntervalsOverlapAreNotCalledBeaten) {
  // Medians 2 and 2.1; the rounds of both go from 1 to 3.1. The third is slower in every frame.
  const Sweep sweep = load({makeRun("a", "s", 1, {1, 1, 1, 2, 2, 2, 3, 3, 3}, 0.1),
                            makeRun("b", "s", 1, {1.1, 1.1, 1.1, 2.1, 2.1, 2.1, 3.1, 3.1, 3.1}, 0.1),
                            makeRun("c", "s", 1, {9, 9, 9, 9, 9, 9, 9, 9, 9}, 0.1)});
  EXPECT_FALSE(sweep.cells[1].beaten);
  EXPECT_TRUE(sweep.cells[2].beaten);
  EXPECT_THAT(sweep.panels[0].verdict.levels.at(0).ties, ElementsAre(1));
}

TEST_F(SweepTest, ThereIsNoVerdictWhereXIsNeitherATimeNorACost) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1), makeRun("a", "s", 4, {1}, 0.05)};
  for (const char* x : {"samples", "rmse"}) {
    for (store::Run& run : runs) run.key += x;
    const Sweep sweep = load(runs, {{"x", x}, {"y", "rmse"}});
    EXPECT_THAT(sweep.noVerdict, testing::HasSubstr("neither a time nor a cost")) << x;
    EXPECT_TRUE(sweep.panels.at(0).front.empty());
    EXPECT_TRUE(sweep.panels.at(0).verdict.levels.empty());
    EXPECT_EQ(sweep.cells[0].frontNumber, 0);
  }
}

TEST_F(SweepTest, ThereIsNoVerdictOverTimesAgainstCosts) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1), makeRun("a", "s", 2, {2}, 0.05)};
  runs[0].measurements.push_back({"nodes_per_px", 10.0, "1/px", "counter"});
  runs[1].measurements.push_back({"nodes_per_px", 20.0, "1/px", "counter"});
  const Sweep sweep = load(runs, {{"x", "nodes_per_px"}, {"y", "gpu_ms"}});
  EXPECT_THAT(sweep.noVerdict, testing::HasSubstr("is a cost itself"));
  EXPECT_FALSE(sweep.counterHasFront());
  EXPECT_TRUE(sweep.panels.at(0).front.empty());
}

TEST_F(SweepTest, ACounterIsACostAndHasAVerdict) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1), makeRun("a", "s", 2, {1}, 0.05)};
  runs[0].measurements.push_back({"nodes_per_px", 10.0, "1/px", "counter"});
  runs[1].measurements.push_back({"nodes_per_px", 20.0, "1/px", "counter"});
  const Sweep sweep = load(runs, {{"x", "nodes_per_px"}, {"y", "rmse"}});
  EXPECT_EQ(sweep.noVerdict, "");
  EXPECT_FALSE(sweep.xIsTime);
  EXPECT_FALSE(sweep.exactTimesTaken);
  EXPECT_THAT(sweep.panels[0].verdict.worth, ElementsAre(0, 1));
}

TEST_F(SweepTest, ThereIsNoVerdictWhereNeitherLessNorMoreErrorIsBetter) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1)};
  runs[0].measurements.push_back({"signed_error", -0.1, "", "error"});
  EXPECT_THAT(load(runs, {{"x", "gpu_ms"}, {"y", "signed_error"}}).noVerdict,
              testing::HasSubstr("neither less nor more is better"));
}

TEST_F(SweepTest, TheNoiseOfTheReferenceIsThatOfTheRunsOwnMetric) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1, 1}, 0.102), makeRun("b", "s", 1, {2, 2}, 0.1)};
  EXPECT_EQ(load(runs).panels[0].verdict.levels[0].cheapest, 1U);
  for (store::Run& run : runs) {
    run.key += "with noise";
    run.measurements.push_back({"rmse_noise", 0.003, "", "fact"});
  }
  const Sweep sweep = load(runs, {{"x", "gpu_ms"}, {"y", "rmse"}});
  EXPECT_EQ(sweep.panels[0].noise, 0.003);
  EXPECT_EQ(sweep.panels[0].verdict.levels[0].cheapest, 0U);
  EXPECT_THAT(sweep.panels[0].verdict.worth, ElementsAre(0));
}

TEST_F(SweepTest, MultiplesOfDecibelsAreThoseOfTheAmplitude) {
  // 20 lg 1.1 = 0.83 dB, 20 lg 2 = 6.02 dB: 39.5 dB is within 1.1 of 40 dB, 34 dB within twice, 33.9 dB is
  // not.
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0), makeRun("b", "s", 1, {2}, 0),
                                  makeRun("c", "s", 1, {3}, 0), makeRun("d", "s", 1, {4}, 0)};
  const double psnr[] = {33.9, 34.0, 39.5, 40.0};
  for (size_t i = 0; i < 4; ++i) runs[i].measurements.push_back({"psnr", psnr[i], "dB", "error"});
  const Sweep sweep = load(runs, {{"x", "gpu_ms"}, {"y", "psnr"}});
  const auto& levels = sweep.panels[0].verdict.levels;
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels[0].cheapest, 3U);
  EXPECT_EQ(levels[1].cheapest, 2U);
  EXPECT_EQ(levels[1].last, 1.5);
  EXPECT_EQ(levels[2].cheapest, 1U);
}

TEST_F(SweepTest, TheCounterThatMostRunsHaveIsTheSecondAxis) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1), makeRun("a", "s", 2, {1}, 0.2),
                                  makeRun("a", "s", 3, {1}, 0.2)};
  for (size_t i = 0; i < 3; ++i) {
    runs[i].measurements.push_back({"constant", 7, "", "counter"});
    runs[i].measurements.push_back({"nodes_per_px", 10.0 + static_cast<double>(i), "1/px", "counter"});
  }
  runs[0].measurements.push_back({"rare", 1, "", "counter"});
  const Sweep sweep = load(runs);
  ASSERT_TRUE(sweep.counter);
  EXPECT_EQ(sweep.counter->name, "nodes_per_px");
  EXPECT_EQ(sweep.cells[2].counter, 12.0);
}

TEST_F(SweepTest, TitlesUnitsAndDirectionsAreTheStoresAndNotGuessedFromNames) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0), makeRun("b", "s", 1, {2}, 0),
                                  makeRun("c", "s", 1, {3}, 0)};
  const double values[] = {30, 20, 40};
  for (size_t i = 0; i < 3; ++i) {
    runs[i].measurements.push_back({"psnr_distance", values[i], "", "error"});
    runs[i].measurements.push_back({"agreement", values[i], "", "error"});
  }
  store::Descriptions said;
  said.quantities = {
      {"psnr_distance", "Distance of signals", "dB", Direction::LowerIsBetter, "error", "", ""},
      {"agreement", "Agreement", "", Direction::HigherIsBetter, "error", "", ""}};
  const Sweep lower = load(runs, {{"x", "gpu_ms"}, {"y", "psnr_distance"}}, {}, said);
  EXPECT_EQ(lower.y.label(), "Distance of signals (dB)");
  EXPECT_THAT(lower.panels[0].front, ElementsAre(0, 1));
  for (store::Run& run : runs) run.key += "again";
  const Sweep higher = load(runs, {{"x", "gpu_ms"}, {"y", "agreement"}}, {}, said);
  EXPECT_EQ(higher.y.label(), "Agreement");
  EXPECT_THAT(higher.panels[0].front, ElementsAre(0, 2));
}

TEST_F(SweepTest, AnErrorOfAnOldStoreThatNobodyKnowsHasNoDirection) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0)};
  runs[0].measurements.push_back({"ssim_of_tomorrow", 1.0, "", "error"});
  const Sweep sweep = load(runs, {{"x", "gpu_ms"}, {"y", "ssim_of_tomorrow"}});
  EXPECT_EQ(sweep.y.direction, std::nullopt);
  EXPECT_EQ(sweep.y.label(), "Ssim of tomorrow");
}

// budget: [none, {kind: radial, rim: [25, 50]}], and for the second technique rim alone varies.
class PartialParameterTest : public SweepTest {
 protected:
  static store::Run run(const std::string& technique, const nlohmann::json& parameters, double ms) {
    store::Run out = makeRun(technique, "s", 1, {ms}, 1.0 / ms);
    out.key = technique + parameters.dump();
    out.label = parameters.dump();
    out.parameters["technique"] = parameters;
    return out;
  }
  static std::vector<store::Run> runs() {
    return {run("a", {{"budget", "none"}}, 3.0), run("a", {{"budget", "radial"}, {"budget.rim", 25}}, 1.0),
            run("a", {{"budget", "radial"}, {"budget.rim", 50}}, 2.0),
            run("b", {{"budget", "radial"}, {"budget.rim", 25}}, 4.0),
            run("b", {{"budget", "radial"}, {"budget.rim", 50}}, 5.0)};
  }
  static store::Descriptions said() {
    store::Descriptions out;
    for (const char* owner : {"a", "b"}) {
      store::ParameterRow budget;
      budget.subject = "technique";
      budget.owner = owner;
      budget.path = "budget";
      budget.title = "Budget";
      store::ParameterRow rim = budget;
      rim.path = "budget.rim";
      rim.when = {{"budget", "radial"}};
      rim.title = "Budget: rim";
      rim.unit = "taps";
      out.parameters.insert(out.parameters.end(), {budget, rim});
    }
    return out;
  }
};

TEST_F(PartialParameterTest, LabelsNameTheOwnerOnceAndLeaveOutWhatARunDoesNotHave) {
  const Sweep sweep = load(runs(), {}, {}, said());
  EXPECT_EQ(sweep.label(sweep.cells[0]), "a, budget none");
  EXPECT_EQ(sweep.label(sweep.cells[1]), "a, budget radial, rim 25 taps");
  EXPECT_EQ(sweep.label(sweep.cells[3]), "b, budget rim 25 taps");
}

TEST_F(PartialParameterTest, ColumnsAreEmptyWhereTheParameterDoesNotExist) {
  const Sweep sweep = load(runs(), {}, {}, said());
  EXPECT_THAT(columnsOf(sweep), ElementsAre("budget", "budget.rim"));
  EXPECT_EQ(sweep.varyingColumns[1].label(), "Budget: rim (taps)");
  EXPECT_EQ(sweep.cells[0].varying.count("budget.rim"), 0U);
  EXPECT_EQ(sweep.cells[1].varying.at("budget.rim"), "25");
}

TEST_F(PartialParameterTest, AnAxisInsideAnAlternativeDrawsTheRunsThatHaveIt) {
  const Sweep sweep = load(
      runs(), {{"x", "budget.rim"}, {"y", "rmse"}, {"series", "technique"}, {"panels", "scene"}}, {}, said());
  EXPECT_EQ(sweep.x.label(), "Budget: rim (taps)");
  EXPECT_FALSE(sweep.cells[0].isDrawn());
  EXPECT_EQ(sweep.cells[2].x, 50.0);
}

TEST_F(PartialParameterTest, SeriesAndPanelsInsideAnAlternativeHaveOneForTheRunsWithoutIt) {
  const Sweep sweep = load(
      runs(), {{"x", "gpu_ms"}, {"y", "rmse"}, {"series", "budget.rim"}, {"panels", "budget"}}, {}, said());
  EXPECT_THAT(sweep.series, ElementsAre("no budget rim", "budget rim 25 taps", "budget rim 50 taps"));
  ASSERT_EQ(sweep.panels.size(), 2U);
  EXPECT_EQ(sweep.panels[0].title, "budget none");
  EXPECT_EQ(sweep.panels[1].title, "budget radial");
}

TEST_F(PartialParameterTest, AnOldStoreNamesThemByTheWordsOfTheirPaths) {
  const Sweep sweep = load(runs());
  EXPECT_EQ(sweep.varyingColumns[1].label(), "Budget: rim");
  EXPECT_EQ(sweep.label(sweep.cells[1]), "a, budget radial, rim 25");
}

}  // namespace
}  // namespace limen::analysis
