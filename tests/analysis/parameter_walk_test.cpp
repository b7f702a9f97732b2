// SPDX-License-Identifier: BSD-3-Clause
// One parameter from a descriptor to the axis of a report (docs/data_flow.md): the whole sweep program runs,
// with a technique that needs no GPU.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "analysis/output/text_output.h"
#include "analysis/sweep/report.h"
#include "experiments/base/settings_table.h"
#include "experiments/plan.h"
#include "experiments/runner.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/experiments/fake_bench.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

// Settings with a unit and a title that no reader could make up from the names.
struct Lens {
  double width = 0.5;
  static const SettingsTable<Lens>& table();
};
const SettingsTable<Lens>& Lens::table() {
  static const SettingsTable<Lens> kTable = {
      Binding<Lens>(&Lens::width, "width", {0.0, 10.0}, "furlong", "How wide it is", "Test 2024, 7")
          .titled("Span of the lens")};
  return kTable;
}

class QuietObserver : public experiments::SweepObserver {
 public:
  void begin(size_t, size_t) override {}
  void measuring(const experiments::PlannedRun&, size_t) override {}
  void finished(const experiments::PlannedRun&, const store::Run&) override {}
  void doneElsewhere(const experiments::PlannedRun&) override {}
  void waiting(size_t) override {}
};

class ParameterWalkTest : public testing::Test {
 protected:
  // Plans and runs a sweep over the lens' width and writes its report.
  std::string reportOf(const std::string& report) {
    Catalogue catalogue = experiments::fakeCatalogue();
    std::vector<Parameter>& declared = catalogue.techniques["soft/pcss"].parameters;
    for (const Parameter& parameter : Lens::table().parameters(Lens())) declared.push_back(parameter);
    catalogue.metrics["rmse"].quantity.title = "Error of the walk";
    const std::string text =
        "title: Walk\n"
        "question: Does it arrive?\n"
        "source: Test 2024\n"
        "scenes: [{name: grid}]\n"
        "techniques: [{name: soft/pcss, width: [0.25, 2, 4]}]\n"
        "reference: {name: soft/sampled}\n"
        "image: {width: 8, height: 8}\n"
        "metrics: [rmse]\n"
        "report: " +
        report + "\n";
    const experiments::Descriptor descriptor =
        experiments::parseDescriptor(text, folder_.path("walk.yaml"), catalogue, {});
    const experiments::Plan plan = experiments::makePlan(descriptor, catalogue);
    {
      store::Store results(folder_.path("s.sqlite"), store::Access::ReadWrite);
      experiments::enterExperiment(descriptor, plan, results);
      experiments::FakeExecutor executor;
      QuietObserver observer;
      experiments::runSweep(plan, results, executor, nlohmann::json::object(), {}, observer);
    }
    return readFileBytes(writeReports({folder_.path("s.sqlite"), folder_.path("out"), "", false}).at(0).page);
  }

  TemporaryFolder folder_;
};

TEST_F(ParameterWalkTest, TitleAndUnitArriveAtTheAxisTheTableAndTheDictionary) {
  const std::string page = reportOf("{x: width, y: rmse, series: technique, panels: scene}");
  // Once as the axis of the chart (gnuplot's text), and as the heading of a column.
  EXPECT_THAT(page, HasSubstr("against Span of the lens (furlong)"));
  EXPECT_THAT(page, HasSubstr("title=\"width\"><button type=\"button\">Span of the lens (furlong)</button>"));
  EXPECT_THAT(page, HasSubstr("Error of the walk"));
  EXPECT_THAT(page, HasSubstr("width 0.25 furlong")) << "the label of a setting";
  EXPECT_THAT(readFileBytes(folder_.path("out/charts/speed_1.gp")), HasSubstr("Span of the lens (furlong)"));
  EXPECT_THAT(readFileBytes(folder_.path("out/runs.csv")), HasSubstr(",technique.width,"));
  EXPECT_THAT(readFileBytes(folder_.path("out/parameters.csv")),
              HasSubstr("technique.width,technique,soft/pcss,width,,Span of the lens,furlong,number,0.5,How "
                        "wide it is,\"Test 2024, 7\""));
  EXPECT_THAT(readFileBytes(folder_.path("out/quantities.csv")),
              HasSubstr("rmse,Error of the walk,,lower,error,,"));
}

TEST_F(ParameterWalkTest, SeriesAndPanelsOfAParameterAreNamedWithItsUnit) {
  const std::string page = reportOf("{x: gpu_ms, y: rmse, series: width, panels: technique}");
  EXPECT_THAT(page, HasSubstr("width 4 furlong"));
  EXPECT_THAT(page, HasSubstr("3 values of Span of the lens (furlong)"));
  EXPECT_THAT(page, HasSubstr("Frame time on the CPU (ms)")) << "the fake device is a software renderer";
  EXPECT_THAT(page, Not(HasSubstr("width=4")));
}

}  // namespace
}  // namespace limen::analysis
