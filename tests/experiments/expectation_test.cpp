// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/expectation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/base/error.h"
#include "experiments/plan.h"
#include "tests/experiments/base/declare.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::HasSubstr;

/// Plans the valid descriptor with one expectation, gives each run the value of `measure`, and evaluates.
store::Expectation evaluated(const std::string& expectation,
                             const std::function<std::optional<double>(const PlannedRun&)>& measure,
                             const std::string& failedLabel = "none") {
  const Catalogue catalogue = fakeCatalogue();
  const Descriptor descriptor =
      parseDescriptor(validDescriptor() + "expect: [" + expectation + "]\n", "d.yaml", catalogue, {});
  const Plan plan = makePlan(descriptor, catalogue);
  std::vector<store::Run> rows(plan.runs.size());
  std::map<std::string, const store::Run*> measured;
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].status = plan.runs[i].label == failedLabel ? "failed" : "done";
    rows[i].error = rows[i].status == "failed" ? "out of memory" : "";
    rows[i].measurements = {{"rmse", measure(plan.runs[i]), "", "error"}};
    measured[plan.runs[i].key] = &rows[i];
  }
  Problems problems("d.yaml");
  const auto resolved = resolve(descriptor.expectations, plan.runs, problems);
  EXPECT_TRUE(problems.empty());
  return evaluate(resolved, plan.runs, measured).at(0);
}

TEST(Expectation, BoundsAreStrictAndEqualityIsExact) {
  const auto half = [](const PlannedRun&) { return 0.5; };
  EXPECT_TRUE(evaluated("{metric: rmse, below: 0.51}", half).held);
  EXPECT_FALSE(evaluated("{metric: rmse, below: 0.5}", half).held);
  EXPECT_TRUE(evaluated("{metric: rmse, above: 0.49}", half).held);
  EXPECT_FALSE(evaluated("{metric: rmse, above: 0.5}", half).held);
  EXPECT_TRUE(evaluated("{metric: rmse, equals: 0.5}", half).held);
  EXPECT_FALSE(evaluated("{metric: rmse, equals: 0.5000001}", half).held);
}

TEST(Expectation, IsAboutTheSelectedRunsAlone) {
  const auto value = [](const PlannedRun& run) { return run.label == "samples=8" ? 9.0 : 1.0; };
  EXPECT_TRUE(evaluated("{metric: rmse, of: soft/pcss, below: 2}", value).held);
  EXPECT_FALSE(evaluated("{metric: rmse, of: soft/bitmask, below: 2}", value).held);
  EXPECT_TRUE(evaluated("{metric: rmse, where: {samples: 16}, below: 2}", value).held);
  EXPECT_FALSE(evaluated("{metric: rmse, where: {samples: 8, light_size: 0.5}, below: 2}", value).held);
}

TEST(Expectation, MayBeAboutWhatATechniqueCounts) {
  const Catalogue catalogue = fakeCatalogue();
  const Descriptor descriptor =
      parseDescriptor(validDescriptor() + "expect: [{metric: fetches_per_px, of: soft/pcss, below: 9}]\n",
                      "d.yaml", catalogue, {});
  EXPECT_EQ(descriptor.expectations.at(0).metric, "fetches_per_px");
  // What only a technique outside the descriptor counts is as unknown as any other name.
  Catalogue other = catalogue;
  other.techniques["soft/pcss"].counters.clear();
  EXPECT_THROW(parseDescriptor(validDescriptor() + "expect: [{metric: fetches_per_px, below: 9}]\n", "d.yaml",
                               other, {}),
               Error);
}

TEST(Expectation, SaysWhichRunBrokeItAndHowMany) {
  const store::Expectation broken =
      evaluated("{metric: rmse, of: soft/bitmask, below: 2}", [](const PlannedRun&) { return 3.0; });
  EXPECT_THAT(broken.detail,
              HasSubstr("soft/bitmask samples=8, grid light_size=0.5: rmse is 3, not below 2"));
  EXPECT_THAT(broken.detail, HasSubstr("and 5 more of 6 runs"));
}

TEST(Expectation, AFailedRunOrNoNumberBreaksIt) {
  const auto one = [](const PlannedRun&) { return 1.0; };
  EXPECT_THAT(evaluated("{metric: rmse, below: 2}", one, "samples=16").detail,
              HasSubstr("failed: out of memory"));
  EXPECT_FALSE(evaluated("{metric: rmse, below: 2}", one, "samples=16").held);
  EXPECT_FALSE(
      evaluated("{metric: rmse, below: 2}", [](const PlannedRun&) { return std::optional<double>(); }).held);
  EXPECT_FALSE(evaluated("{metric: rmse, below: 2}", [](const PlannedRun&) { return std::nan(""); }).held);
}

TEST(Expectation, ComparesRunsOfTheSameSceneAndSize) {
  // The filtered map has ten times the bitmask's error in either scene; across scenes the ratio would be
  // wrong.
  const auto value = [](const PlannedRun& run) {
    const double scene = realOf(run.scene.values, "light_size") < 0.75 ? 100.0 : 1.0;
    return scene * (run.technique.name == "soft/pcss" ? 10.0 : 1.0);
  };
  const std::string baseline = "relative_to: {of: soft/pcss, where: {radius: 0.02}}";
  EXPECT_TRUE(evaluated("{metric: rmse, of: soft/bitmask, below: 0.11, " + baseline + "}", value).held);
  EXPECT_TRUE(evaluated("{metric: rmse, of: soft/bitmask, above: 0.09, " + baseline + "}", value).held);
  EXPECT_FALSE(evaluated("{metric: rmse, of: soft/bitmask, below: 0.09, " + baseline + "}", value).held);
}

TEST(Expectation, ComparesRunsOfOneTechniqueThatDifferInOneParameter) {
  const auto value = [](const PlannedRun& run) { return fakeRmse(run); };
  // 1/32 against 1/8: a quarter.
  const std::string common =
      "metric: rmse, of: soft/bitmask, where: {samples: 32}, relative_to: {where: {samples: 8}}";
  EXPECT_TRUE(evaluated("{" + common + ", equals: 0.25}", value).held);
  EXPECT_FALSE(evaluated("{" + common + ", below: 0.25}", value).held);
  // Two lights, the same bitmask: the scene's parameter alone differs.
  EXPECT_TRUE(
      evaluated("{metric: rmse, where: {light_size: 1}, relative_to: {where: {light_size: 0.5}}, equals: 1}",
                value)
          .held);
}

/// Labels of the baselines of soft/bitmask (sleep_ms 1 and 2) when soft/pcss is planned with `pcssValues`.
std::vector<std::string> baselineLabels(const std::string& pcssValues) {
  const Catalogue catalogue = fakeCatalogue();
  const Descriptor descriptor = parseDescriptor(
      "title: a\nquestion: b\nscenes: [{name: grid}]\nmetrics: [crack_count]\n"
      "techniques: [{name: soft/bitmask, sleep_ms: [1, 2]}, {name: soft/pcss, " +
          pcssValues +
          "}]\n"
          "expect: [{metric: gpu_ms, of: soft/bitmask, below: 1, relative_to: {of: soft/pcss}}]\n",
      "d.yaml", catalogue, {});
  const Plan plan = makePlan(descriptor, catalogue);
  Problems problems("d.yaml");
  std::vector<std::string> out;
  const auto resolved = resolve(descriptor.expectations, plan.runs, problems);
  for (const auto& one : resolved.at(0).cases) out.push_back(plan.runs[*one.baseline].label);
  return out;
}

TEST(Expectation, AnotherTechniqueIsMatchedByWhatBothHave) {
  // One run of the other technique is meant whatever its values; of several, the one with the same value.
  EXPECT_THAT(baselineLabels("sleep_ms: 3"), testing::ElementsAre("", ""));
  EXPECT_THAT(baselineLabels("sleep_ms: [2, 1]"), testing::ElementsAre("sleep_ms=1", "sleep_ms=2"));
}

TEST(Expectation, ABaselineOfZeroNeedsNoDivision) {
  const auto zero = [](const PlannedRun&) { return 0.0; };
  const std::string baseline = "relative_to: {of: soft/pcss, where: {radius: 0.02}}";
  EXPECT_TRUE(evaluated("{metric: rmse, of: soft/bitmask, equals: 1, " + baseline + "}", zero).held);
  EXPECT_FALSE(evaluated("{metric: rmse, of: soft/bitmask, below: 1, " + baseline + "}", zero).held);
}

}  // namespace
}  // namespace limen::experiments
