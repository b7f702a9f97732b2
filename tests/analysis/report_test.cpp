// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

class ReportTest : public testing::Test {
 protected:
  int64_t write(std::vector<store::Run> runs, const std::string& title = "t",
                const std::vector<store::PlanEntry>& missing = {}, bool software = false) {
    store::Store store(folder_.path("s.sqlite"), store::Access::ReadWrite);
    store::Experiment experiment;
    experiment.title = title;
    return writeExperiment(store, experiment, std::move(runs), missing,
                           {"Test GPU", software, {{"command", "limen-sweep 'a b.yaml'"}}});
  }
  std::string report(bool force = false, const std::string& experiment = {}) {
    results_ = writeReports({folder_.path("s.sqlite"), folder_.path("out"), experiment, force});
    return readFileBytes(results_.at(0).page);
  }
  std::string errorOf(const std::string& experiment = {}) {
    try {
      report(false, experiment);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  size_t linesOf(const std::string& file) {
    const std::string text = readFileBytes(folder_.path("out/" + file));
    return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  TemporaryFolder folder_;
  std::vector<ReportResult> results_;
};

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

TEST_F(ReportTest, HasAMarkARowAndACsvLineForEachRun) {
  write({makeRun("a", "s", 1, {1, 2, 3}, 0.5), makeRun("a", "s", 2, {2, 2, 2}, 0.1),
         makeRun("b", "r", 1, {4}, 0.3)});
  const std::string page = report();
  EXPECT_EQ(count(page, "<g class=\"mark "), 3U);
  EXPECT_EQ(count(page, "<tr data-run="), 3U);
  EXPECT_EQ(linesOf("runs.csv"), 4U);
  EXPECT_EQ(linesOf("frame_times.csv"), 1U + 7U);
  EXPECT_EQ(linesOf("measurements.csv"), 1U + 6U);
  EXPECT_EQ(results_[0].runs, 3U);
  EXPECT_THAT(page, HasSubstr("limen-sweep &#39;a b.yaml&#39;"));
  EXPECT_THAT(readFileBytes(folder_.path("out/runs.csv")), HasSubstr("technique.samples"));
}

TEST_F(ReportTest, OpensWithoutANetwork) {
  write({makeRun("a", "s", 1, {1}, 0.5)});
  std::string page = report();
  for (const std::string name :
       {"xmlns=\"http://www.w3.org/2000/svg\"", "xmlns:xlink=\"http://www.w3.org/1999/xlink\""})
    for (size_t at; (at = page.find(name)) != std::string::npos;) page.erase(at, name.size());
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
}

TEST_F(ReportTest, AnIncompleteSweepIsRefusedAndNothingIsWritten) {
  write({makeRun("a", "s", 1, {1}, 0.5)}, "t", {{"k", "b", "s", "samples=9"}});
  EXPECT_THAT(errorOf(),
              testing::AllOf(HasSubstr("not complete"), HasSubstr("samples=9"), HasSubstr("--force")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
}

TEST_F(ReportTest, AFailedRunIsRefusedUnlessForcedAndThenNamedOnThePage) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.5), makeRun("b", "s", 1, {}, 0.5)};
  runs[1].status = "failed";
  runs[1].error = "shader <pass.glsl> & more";
  write(runs);
  EXPECT_THAT(errorOf(), HasSubstr("shader <pass.glsl>"));
  const std::string page = report(true);
  EXPECT_THAT(page, HasSubstr("This sweep is not complete."));
  EXPECT_THAT(page, HasSubstr("Of 2 planned runs 1 failed and 0 are missing"));
  EXPECT_THAT(page, HasSubstr("shader &lt;pass.glsl&gt; &amp; more"));
  EXPECT_LT(page.find("This sweep is not complete."), page.find("In short"));
  EXPECT_EQ(results_[0].failed, 1U);
}

TEST_F(ReportTest, OnlyFailedRunsStillGiveAPageWhenForced) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {}, 0.5)};
  runs[0].status = "failed";
  write(runs);
  EXPECT_THAT(report(true), HasSubstr("This sweep is not complete."));
}

TEST_F(ReportTest, NamesWithMarkupStayText) {
  const std::string nasty = "x<script>alert(1)</script>&'\"größer\\";
  std::vector<store::Run> runs = {makeRun(nasty, nasty, 1, {1}, 0.5), makeRun(nasty, nasty, 2, {2}, 0.25)};
  runs[0].label = nasty;
  runs[0].parameters["technique"][nasty] = nasty;
  write(runs, nasty);
  const std::string page = report();
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, HasSubstr("x&lt;script&gt;alert(1)"));
  EXPECT_THAT(page, HasSubstr("größer"));
  EXPECT_EQ(count(page, "<script>"), 1U);
}

TEST_F(ReportTest, AnErrorOfZeroIsDrawnAtTheFootAndExplained) {
  write({makeRun("a", "s", 1, {1}, 0.0), makeRun("a", "s", 2, {2}, 0.5)});
  const std::string page = report();
  EXPECT_EQ(count(page, "<g class=\"mark "), 2U);
  EXPECT_THAT(page, HasSubstr("data-y=\"0\""));
  EXPECT_THAT(page, HasSubstr("has exactly that value"));
}

TEST_F(ReportTest, ErrorsThatAreAllZeroAreDrawn) {
  write({makeRun("a", "s", 1, {1}, 0.0), makeRun("a", "s", 2, {2}, 0.0)});
  EXPECT_EQ(count(report(), "<g class=\"mark "), 2U);
}

TEST_F(ReportTest, AnInfiniteSignalToNoiseRatioIsDrawnAndExplained) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.1), makeRun("a", "s", 2, {2}, 0.0)};
  runs[0].measurements.push_back({"psnr", 20.0, "dB", "error"});
  runs[1].measurements.push_back({"psnr", INFINITY, "dB", "error"});
  {
    store::Store store(folder_.path("s.sqlite"), store::Access::ReadWrite);
    store::Experiment experiment;
    experiment.title = "t";
    experiment.report = {{"x", "gpu_ms"}, {"y", "psnr"}};
    writeExperiment(store, experiment, runs);
  }
  const std::string page = report();
  EXPECT_EQ(count(page, "<g class=\"mark "), 2U);
  EXPECT_THAT(page, HasSubstr("data-y=\"inf\""));
  EXPECT_THAT(page, HasSubstr("has exactly that value"));
}

TEST_F(ReportTest, ARunWithoutTheErrorStandsInTheTableOnly) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.5), makeRun("a", "s", 2, {2}, 0.5)};
  runs[1].measurements.back().value = std::nullopt;
  write(runs);
  const std::string page = report();
  EXPECT_EQ(count(page, "<g class=\"mark "), 1U);
  EXPECT_EQ(count(page, "<tr data-run="), 2U);
  EXPECT_THAT(page, HasSubstr("stands in the table only"));
}

TEST_F(ReportTest, ASoftwareRendererIsNamedInPlainWordsAndAGpuIsNot) {
  write({makeRun("a", "s", 1, {1}, 0.5)}, "gpu", {}, false);
  EXPECT_THAT(report(), Not(HasSubstr("software renderer on a CPU")));
  std::vector<store::Run> runs = {makeRun("a", "s", 2, {1}, 0.5)};
  write(runs, "cpu", {}, true);
  const std::string page = report(false, "cpu");
  EXPECT_THAT(page, HasSubstr("These times were made by a software renderer on a CPU."));
  EXPECT_LT(page.find("software renderer"), page.find("In short"));
}

TEST_F(ReportTest, BrokenExpectationsAreSaidAtTheTop) {
  const int64_t id = write({makeRun("a", "s", 1, {1}, 0.5)});
  {
    store::Store store(folder_.path("s.sqlite"), store::Access::ReadWrite);
    store.putExpectations(id, {{"rmse below 0.1", false, "0.5 in run x"}, {"gpu_ms below 9", true, ""}});
  }
  const std::string page = report();
  EXPECT_THAT(page, HasSubstr("1 of 2 expectations is broken"));
  EXPECT_THAT(page, HasSubstr("0.5 in run x"));
  EXPECT_EQ(results_[0].brokenExpectations, 1U);
}

TEST_F(ReportTest, SeveralExperimentsGetAFolderEachAndOneCanBeChosen) {
  write({makeRun("a", "s", 1, {1}, 0.5)}, "first");
  write({makeRun("b", "s", 1, {1}, 0.5)}, "second");
  report();
  ASSERT_EQ(results_.size(), 2U);
  EXPECT_NE(results_[0].page, results_[1].page);
  report(false, "second");
  ASSERT_EQ(results_.size(), 1U);
  EXPECT_EQ(results_[0].page, folder_.path("out/report.html"));
  report(false, sha256("first").substr(0, 10));
  EXPECT_EQ(results_.at(0).title, "first");
  EXPECT_THAT(errorOf("secnd"), HasSubstr("did you mean 'second'"));
}

TEST_F(ReportTest, NamesASettingOnceWhereSeveralLevelsHaveIt) {
  write({makeRun("a", "s", 1, {1, 1}, 0.5), makeRun("b", "s", 1, {2, 2}, 0.1)});
  const std::string page = report();
  EXPECT_EQ(count(page, "<td data-level="), 1U);
  EXPECT_THAT(page, HasSubstr("up to 2 ×"));
}

TEST_F(ReportTest, DoesNotCallALittleLessErrorForMuchMoreTimeWorthIt) {
  write({makeRun("a", "s", 1, {1, 1}, 0.1), makeRun("b", "s", 1, {9.4, 9.4}, 0.095)});
  EXPECT_THAT(report(), HasSubstr("worth its time is 1 of 2 settings: 1 of a"));
}

class VisibleReport : public ReportTest {
 protected:
  struct Setting {
    const char* technique;
    std::vector<double> ms;
    double jnd;
  };
  /// A report on runs with a visible difference each; y: the charts' axis.
  std::string reportOf(const std::vector<Setting>& settings, const std::string& y) {
    std::vector<store::Run> runs;
    for (const Setting& setting : settings) {
      runs.push_back(makeRun(setting.technique, "s", 1, setting.ms, 0.1));
      runs.back().measurements.push_back({"jnd_p95", setting.jnd, "JND", "error"});
      runs.back().parameters["metrics"] = {
          {{"name", "jnd"}, {"display", "phone_6"}, {"display.distance_m", 0.3}}};
    }
    store::Descriptions described;
    described.quantities = {
        {"gpu_ms", "GPU time", "ms", Direction::LowerIsBetter, "time", "frame", ""},
        {"rmse", "RMSE", "", Direction::LowerIsBetter, "error", "", ""},
        {"jnd_p95", "Visible difference", "JND", Direction::LowerIsBetter, "error", "", ""}};
    {
      store::Store store(folder_.path("s.sqlite"), store::Access::ReadWrite);
      store::Experiment experiment;
      experiment.title = "t";
      experiment.report = {{"x", "gpu_ms"}, {"y", y}};
      writeExperiment(store, experiment, std::move(runs), {}, {"Test GPU", false, {{"command", "x"}}},
                      described);
    }
    return report();
  }
};

TEST_F(VisibleReport, NamesTheCheapestSettingBelowOneJndAndMarksIt) {
  const std::string page =
      reportOf({{"cheap", {1, 1}, 1.5}, {"fits", {2, 2}, 0.99}, {"dear", {5, 5}, 0.2}}, "jnd_p95");
  EXPECT_THAT(page, HasSubstr("the cheapest setting below 1 JND is fits, samples=1: 2 ms, 0.99 JND"));
  EXPECT_THAT(page, HasSubstr("on the display phone_6 from 0.3 m"));
  EXPECT_EQ(count(page, "class=\"ring\""), 1U);
  EXPECT_THAT(page, HasSubstr(">1 JND</"));
  EXPECT_THAT(page, HasSubstr("cheapest below 1 JND"));
}

TEST_F(VisibleReport, OneJndItselfIsNotBelow) {
  EXPECT_THAT(reportOf({{"at", {1, 1}, 1.0}, {"fits", {2, 2}, 0.5}}, "jnd_p95"),
              HasSubstr("below 1 JND is fits, samples=1: 2 ms, 0.5 JND"));
}

TEST_F(VisibleReport, SaysThatNoSettingIsBelow) {
  const std::string page = reportOf({{"a", {1, 1}, 3.0}, {"b", {2, 2}, 1.25}}, "jnd_p95");
  EXPECT_THAT(page, HasSubstr("no setting is below 1 JND; the closest is b, samples=1 with 1.25 JND"));
  EXPECT_EQ(count(page, "class=\"ring\""), 0U);
}

TEST_F(VisibleReport, TimesNotToldApartAreTies) {
  const std::string page = reportOf({{"a", {2.0, 2.2, 2.1}, 0.9}, {"b", {2.1, 2.3, 2.2}, 0.5}}, "jnd_p95");
  EXPECT_THAT(page.substr(page.find("What a viewer")), HasSubstr("≈ b"));
}

// A chart of another error is left as it is; what a viewer would see is said all the same.
TEST_F(VisibleReport, IsSaidBesideAnotherError) {
  const std::string page = reportOf({{"a", {1, 1}, 3.0}, {"b", {2, 2}, 0.5}}, "rmse");
  EXPECT_THAT(page, HasSubstr("What a viewer would see"));
  EXPECT_EQ(count(page, "class=\"ring\""), 0U);
  EXPECT_THAT(page, Not(HasSubstr(">1 JND</")));
}

TEST_F(ReportTest, SaysNothingOfVisibleDifferencesWithoutAny) {
  write({makeRun("a", "s", 1, {1, 1}, 0.5)});
  EXPECT_THAT(report(), Not(HasSubstr("What a viewer would see")));
}

TEST_F(ReportTest, SaysWhyThereIsNoVerdictAndDrawsNoFront) {
  {
    store::Store store(folder_.path("s.sqlite"), store::Access::ReadWrite);
    store::Experiment experiment;
    experiment.title = "t";
    experiment.report = {{"x", "samples"}, {"y", "rmse"}};
    writeExperiment(store, experiment,
                    {makeRun("a", "s", 1, {1, 1}, 0.5), makeRun("a", "s", 2, {2, 2}, 0.1)});
  }
  const std::string page = report();
  EXPECT_THAT(page, HasSubstr("“Samples” is neither a time nor a cost"));
  for (const char* word : {"class=\"front-line\"", "worth", "Pareto", "faster"})
    EXPECT_THAT(page.substr(page.find("<main>"), page.find("<script>") - page.find("<main>")),
                Not(HasSubstr(word)));
}

TEST_F(ReportTest, TwoDevicesAreTwoPanelsAndThePageSaysSo) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1, 1}, 0.5), makeRun("b", "s", 1, {2, 2}, 0.1)};
  runs[1].device = "slow GPU";
  write(runs);
  const std::string page = report();
  EXPECT_THAT(page, HasSubstr("The runs come from several devices."));
  EXPECT_THAT(page, HasSubstr("<h3>s — Test GPU</h3>"));
  EXPECT_THAT(page, HasSubstr("<h3>s — slow GPU</h3>"));
}

TEST_F(ReportTest, ErrorStandsBesideTimeAndWhatIsTheSameInAllRunsAboveTheTable) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1, 1}, 0.5), makeRun("b", "s", 1, {2, 2}, 0.1)};
  for (store::Run& run : runs) run.measurements.push_back({"timed_frames", 7, "", "fact"});
  write(runs);
  const std::string page = report(), table = page.substr(page.find("<section id=\"runs\">"));
  const size_t body = table.find("<thead>");
  const size_t time = table.find("GPU time (ms)", body), error = table.find("RMSE", body);
  ASSERT_NE(time, std::string::npos);
  EXPECT_EQ(count(table.substr(time, error - time), "<th"), 1U) << "the next heading";
  EXPECT_THAT(table.substr(0, body), HasSubstr("Timed frames 7"));
  EXPECT_EQ(table.find("Timed frames", body), std::string::npos);
}

TEST_F(ReportTest, AMissingPictureIsANoteAndNotAnError) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.5)};
  runs[0].artefacts = {{"product_png", "gone.png", std::string(64, '0')}};
  write(runs);
  EXPECT_THAT(report(), HasSubstr("A picture cannot be shown"));
}

TEST_F(ReportTest, APictureOutsideTheStoresFolderIsNotRead) {
  std::vector<store::Run> runs = {makeRun("a", "s", 1, {1}, 0.5)};
  runs[0].artefacts = {{"product_png", "../../etc/hostname", std::string(64, '0')}};
  write(runs);
  EXPECT_THAT(report(), HasSubstr("leaves the store&#39;s folder"));
}

TEST_F(ReportTest, TheSameStoreGivesTheSameBytes) {
  write({makeRun("a", "s", 1, {1, 2, 3, 4, 5, 6}, 0.5), makeRun("a", "s", 2, {2, 3, 2}, 0.1)});
  const std::string first = report();
  EXPECT_EQ(first, report());
}

}  // namespace
}  // namespace limen::analysis
