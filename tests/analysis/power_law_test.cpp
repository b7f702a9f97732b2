// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/power_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/output/result_renderers.h"
#include "analysis/sweep/page.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(PowerLaw, IsFoundWithoutError) {
  const std::optional<PowerLaw> law = fitPowerLaw({{2, 12}, {4, 48}, {10, 300}, {1e6, 3e12}});
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 2.0, 1e-13);
  EXPECT_NEAR(law->factor, 3.0, 1e-11);
  EXPECT_NEAR(law->exponent95->low, 2.0, 1e-12);
  EXPECT_NEAR(law->departure, 1.0, 1e-12);
}

/// Worked by hand with logarithms of e: x at 0, 1, 2, 3, y at 0, 1, 1, 2. Slope 3 / 5, residuals
/// -.1, .3, -.3, .1: variance .2 / 2, standard error sqrt(.1 / 5), t of 2 degrees at 95 %: 4.30265.
TEST(PowerLaw, IntervalIsOfStudentsT) {
  const auto e = [](double power) { return std::exp(power); };
  const std::optional<PowerLaw> law = fitPowerLaw({{e(0), e(0)}, {e(1), e(1)}, {e(2), e(1)}, {e(3), e(2)}});
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 0.6, 1e-14);
  EXPECT_NEAR(law->factor, std::exp(0.1), 1e-14);
  EXPECT_NEAR(law->exponent95->high - law->exponent, 4.30265273 * std::sqrt(0.02), 1e-8);
  EXPECT_NEAR(law->departure, std::exp(0.3), 1e-14);
}

TEST(PowerLaw, NeedsTwoPlaces) {
  EXPECT_FALSE(fitPowerLaw({}));
  EXPECT_FALSE(fitPowerLaw({{3, 1}}));
  EXPECT_FALSE(fitPowerLaw({{3, 1}, {3, 2}, {3, 4}}));
  const std::optional<PowerLaw> two = fitPowerLaw({{1, 5}, {10, 50}});
  ASSERT_TRUE(two);
  EXPECT_NEAR(two->exponent, 1.0, 1e-14);
  EXPECT_FALSE(two->exponent95);
}

class ScalingTest : public testing::Test {
 protected:
  /// `samples` and the scene's `size` vary; the error is `factor` samples^exponent.
  store::Run run(const std::string& technique, int samples, double size, double rmse) {
    store::Run out = makeRun(technique, "s", samples, {1.0 * samples}, rmse);
    out.parameters["scene"]["size"] = size;
    out.key += std::to_string(size);
    return out;
  }
  Sweep load(std::vector<store::Run> runs, const nlohmann::json& report) {
    store::Experiment experiment;
    experiment.title = "t";
    experiment.hash = "t" + report.dump();
    experiment.report = report;
    writeExperiment(store_, experiment, std::move(runs));
    return loadSweep(store_, store_.experiments().back());
  }

  TemporaryFolder folder_;
  store::Store store_{folder_.path("s.sqlite"), store::Access::ReadWrite};
};

TEST_F(ScalingTest, RunsThatDifferInNothingElseAreFitted) {
  std::vector<store::Run> runs;
  for (const int samples : {4, 16, 64}) {
    runs.push_back(run("x/a", samples, 1.0, 1.0 / std::sqrt(samples)));
    runs.push_back(run("x/a", samples, 2.0, 5.0 / samples));
    runs.push_back(run("x/b", samples, 1.0, samples == 4 ? 0.0 : 2.0 / samples));
  }
  const Sweep sweep = load(runs, {{"x", "samples"}, {"y", "rmse"}, {"fit", "samples"}});
  const std::vector<Scaling> scalings = findScalings(sweep);
  ASSERT_EQ(scalings.size(), 3U);
  EXPECT_EQ(scalings[0].technique, "a");
  EXPECT_EQ(scalings[0].settings, "size 1");
  EXPECT_EQ(scalings[0].n, 3U);
  EXPECT_EQ(scalings[0].xLow, 4.0);
  EXPECT_EQ(scalings[0].xHigh, 64.0);
  EXPECT_NEAR(scalings[0].law->exponent, -0.5, 1e-12);
  EXPECT_NEAR(scalings[1].law->exponent, -1.0, 1e-12);
  EXPECT_NEAR(scalings[1].law->factor, 5.0, 1e-11);
  // An error of 0 has no logarithm.
  EXPECT_EQ(scalings[2].technique, "b");
  EXPECT_EQ(scalings[2].leftOut, 1U);
  EXPECT_EQ(scalings[2].n, 2U);
  EXPECT_NEAR(scalings[2].law->factor, 2.0, 1e-11);
  const std::string csv = toCsv(tableOf(sweep, scalings));
  EXPECT_THAT(csv, HasSubstr("scene,technique,settings"));
  EXPECT_THAT(csv, HasSubstr("exponent_low"));
  EXPECT_THAT(csv, Not(HasSubstr("<")));
  EXPECT_THAT(renderScalings(sweep), HasSubstr("<code>samples</code>"));
}

TEST_F(ScalingTest, ParametersMayVaryTogether) {
  std::vector<store::Run> runs;
  for (const int samples : {4, 16, 64}) runs.push_back(run("a", samples, samples, 8.0 * samples));
  Sweep sweep = load(runs, {{"x", "gpu_ms"}, {"y", "rmse"}, {"fit", "samples, size"}});
  const std::vector<Scaling> scalings = findScalings(sweep);
  ASSERT_EQ(scalings.size(), 1U);
  EXPECT_EQ(scalings[0].settings, "");
  EXPECT_NEAR(scalings[0].law->exponent, 1.0, 1e-12);
  // Each by itself where only one of them is named.
  sweep.experiment.report["fit"] = "size";
  EXPECT_EQ(findScalings(sweep).size(), 3U);
}

TEST_F(ScalingTest, NothingIsFittedUnasked) {
  const Sweep sweep = load({run("a", 4, 1, 1)}, {{"x", "samples"}, {"y", "rmse"}});
  EXPECT_TRUE(findScalings(sweep).empty());
  EXPECT_EQ(renderScalings(sweep), "");
}

}  // namespace
}  // namespace limen::analysis
