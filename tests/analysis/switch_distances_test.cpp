// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/switch_distances.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/output/result_renderers.h"
#include "experiments/base/error.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;

/// Two switches, three views, five distances. The probability falls linearly in lg distance from 1 at 1 to 0
/// at 100 for level 1, and from 1 at 2 to 0 at 200 for level 2; views shift it by -0.1, 0, 0.1. So at 0.5
/// level 1 may switch from 10, level 2 from 20.
void writeSwitches(const std::string& path, int drop = 0) {
  store::Store store(path, store::Access::ReadWrite);
  store::Experiment experiment;
  experiment.title = "switches";
  std::vector<store::Run> runs;
  std::vector<store::PlanEntry> missing;
  for (const int level : {1, 2})
    for (const int view : {-1, 0, 1})
      for (const double distance : {1.0, 3.0, 9.0, 27.0, 81.0}) {
        store::Run run = makeRun("popping/lod_switch", "lod/object", 1, {1.0}, 0.0);
        run.key += std::to_string(level) + "_" + std::to_string(view) + "_" + std::to_string(distance);
        run.parameters = {{"technique", {{"to_level", level}}},
                          {"scene", {{"distance", distance}, {"azimuth_deg", 120 * view}}},
                          {"image", {{"width", 64}}}};
        const double p = 1.0 - 0.5 * std::log10(distance / level) + 0.1 * view;
        run.measurements.push_back({"detection_probability", p, "", "fact"});
        if (drop-- > 0)
          missing.push_back({run.key, run.technique, run.scene, "dropped"});
        else
          runs.push_back(run);
      }
  writeExperiment(store, experiment, runs, missing);
}

TEST(SwitchDistances, AreThoseAtWhichTheProbabilityIsAsAsked) {
  const TemporaryFolder folder;
  writeSwitches(folder.path("s.sqlite"));
  SwitchOptions options;
  options.storePath = folder.path("s.sqlite");
  const std::vector<SwitchReport> reports = findSwitchDistances(options);
  ASSERT_EQ(reports.size(), 1U);
  ASSERT_EQ(reports[0].switches.size(), 2U);
  for (size_t i = 0; i < 2; ++i) {
    const SwitchDistance& one = reports[0].switches[i];
    const double scale = i == 0 ? 1.0 : 2.0;
    EXPECT_EQ(one.condition.size(), 1U) << "what does not vary is no condition";
    EXPECT_EQ(one.condition.at("to_level"), i == 0 ? "1" : "2");
    EXPECT_NEAR(one.estimate.ofMean.x, 10.0 * scale, 1e-9);
    // The highest view has 0.1 more, which is a fifth of a decade.
    EXPECT_NEAR(one.estimate.farthest.x, scale * std::pow(10.0, 1.2), 1e-9);
    EXPECT_NEAR(one.estimate.high->x, scale * std::pow(10.0, 1.2), 1e-9);
    EXPECT_NEAR(one.estimate.low->x, scale * std::pow(10.0, 0.8), 1e-9);
  }
}

TEST(SwitchDistances, JsonAndChartHoldTheEstimates) {
  const TemporaryFolder folder;
  writeSwitches(folder.path("s.sqlite"));
  SwitchOptions options;
  options.storePath = folder.path("s.sqlite");
  options.probability = 0.999;  // level 1 is below that at 3 already, and at 1 it is 1
  const SwitchReport report = findSwitchDistances(options).at(0);
  const nlohmann::json json = toJson(resultOf(report));
  EXPECT_EQ(json.at("switches").at(1).at("to_level"), "2");
  EXPECT_EQ(json.at("switches").at(1).at("bound"), "within");
  EXPECT_TRUE(json.at("curves").is_array());
  const std::string svg = drawSwitchChart(report, folder.path("s.svg"));
  std::ifstream in(svg);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  EXPECT_THAT(text, HasSubstr("to_level=2"));
  EXPECT_THAT(toText(resultOf(report)), HasSubstr("to_level=1"));
}

TEST(SwitchDistances, AreNamedByTheirLevelsAndSayInWhichWindowTheyHold) {
  const TemporaryFolder folder;
  writeSwitches(folder.path("s.sqlite"));
  SwitchOptions options;
  options.storePath = folder.path("s.sqlite");
  SwitchReport report = findSwitchDistances(options).at(0);
  EXPECT_EQ(report.seen.at("width"), "64");
  EXPECT_THAT(toText(resultOf(report)), testing::Not(HasSubstr("window"))) << "the height is not known";
  report.seen["height"] = "48";
  report.seen["display"] = "laptop_14";
  report.switches[0].condition = {{"from_level", "1"}, {"speed", "2"}, {"to_level", "0"}};
  EXPECT_THAT(toText(resultOf(report)), HasSubstr("in a window of 64 x 48 px, display laptop_14"));
  EXPECT_THAT(toText(resultOf(report)), HasSubstr("level 1 to 0, speed=2"));
  EXPECT_EQ(toJson(resultOf(report)).at("height"), "48");
}

TEST(SwitchDistances, RefuseWhatWouldMislead) {
  const TemporaryFolder folder;
  writeSwitches(folder.path("s.sqlite"), 2);
  SwitchOptions options;
  options.storePath = folder.path("s.sqlite");
  EXPECT_THROW(findSwitchDistances(options), Error) << "two runs are missing";
  options.force = true;
  EXPECT_THROW(findSwitchDistances(options), Error) << "one view lacks distances that the others have";
  writeSwitches(folder.path("t.sqlite"));
  options.storePath = folder.path("t.sqlite");
  options.distance = "range";
  EXPECT_THROW(findSwitchDistances(options), Error);
  options.distance = "distance";
  options.measurement = "rating";
  EXPECT_THROW(findSwitchDistances(options), Error);
  options.measurement = "detection_probability";
  options.probability = 1.0;
  EXPECT_THROW(findSwitchDistances(options), Error);
}

}  // namespace
}  // namespace limen::analysis
