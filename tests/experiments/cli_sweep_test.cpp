// SPDX-License-Identifier: BSD-3-Clause
#include <sys/stat.h>

#include <set>

#include "experiments/store/store.h"
#include "tests/experiments/cli_fixture.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string slowDescriptor(const std::string& extra = "") {
  return "title: Slow\nquestion: Is it?\nscenes: [{name: grid, light_size: [1, 2]}]\n"
         "techniques:\n  - {name: soft/bitmask, samples: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10], sleep_ms: 20}\n"
         "timing: {batch: 2}\nmetrics: [crack_count]\n" +
         extra;
}

TEST_F(SweepCli, MeasuresEverythingOnceAndThenNothing) {
  write("d.yaml", validDescriptor());
  const CallResult first = call({"d.yaml", "--no-report"});
  EXPECT_EQ(first.exitCode, 0) << first.err;
  EXPECT_THAT(first.out,
              AllOf(HasSubstr("[ 1/10] soft/bitmask samples=8 · grid light_size=0.5 · 0.8 ms · rmse 0.125"),
                    HasSubstr("[10/10] "), HasSubstr("10 planned, 10 measured, 0 done before, 0 failed")));
  EXPECT_THAT(first.out, Not(HasSubstr("\x1b"))) << "terminal codes in plain output";
  ASSERT_TRUE(exists("results/d.sqlite"));
  const CallResult second = call({"d.yaml", "--no-report"});
  EXPECT_EQ(second.exitCode, 0);
  EXPECT_THAT(second.out, HasSubstr("10 planned, 0 measured, 10 done before, 0 failed"));
}

TEST_F(SweepCli, MeasuresAgainOnAnotherDevice) {
  write("d.yaml", validDescriptor());
  call({"d.yaml", "--no-report"});
  setenv("FAKE_DEVICE", "another device", 1);
  const CallResult result = call({"d.yaml", "--no-report"});
  unsetenv("FAKE_DEVICE");
  EXPECT_THAT(result.out, HasSubstr("10 planned, 10 measured"));
}

TEST_F(SweepCli, StoreHoldsPlanMeasurementsAndProvenance) {
  write("d.yaml", validDescriptor() + "features: [SS-12]\n");
  ASSERT_EQ(call({"d.yaml", "--no-report", "--store", "my results/it's.sqlite"}).exitCode, 0);
  const store::Store results(path("my results/it's.sqlite"), store::Access::ReadOnly);
  ASSERT_EQ(results.experiments().size(), 1U);
  const store::Experiment experiment = results.experiments()[0];
  EXPECT_EQ(experiment.title, "Bitmask against a filtered map");
  EXPECT_EQ(experiment.descriptor, read("d.yaml"));
  EXPECT_EQ(experiment.features, nlohmann::json{"SS-12"});
  EXPECT_EQ(results.plan(experiment.id).size(), 10U);
  const auto runs = results.runs(experiment.id, true);
  ASSERT_EQ(runs.size(), 10U);
  EXPECT_EQ(runs[0].label, "samples=8");
  EXPECT_EQ(runs[0].parameters["scene"]["light_size"], 0.5);
  EXPECT_EQ(runs[0].parameters["image"]["width"], 64);
  EXPECT_EQ(runs[0].parameters["timing"]["frames"], 4);
  EXPECT_EQ(runs[0].parameters["metrics"][0]["name"], "rmse");
  EXPECT_EQ(runs[0].frameTimes.size(), 4U);
  EXPECT_EQ(runs[0].passes.size(), 1U);
  const auto facts = results.environment(runs[0].environment).facts;
  EXPECT_EQ(facts["gpu"], "fake device");
  EXPECT_EQ(facts["command"], "limen-sweep d.yaml --no-report --store 'my results/it'\\''s.sqlite'");
  for (const char* fact : {"cpu", "cores", "memory_bytes", "os", "kernel", "compiler", "build_type",
                           "libraries", "commit", "working_directory", "time"})
    EXPECT_TRUE(facts.contains(fact)) << fact;
}

TEST_F(SweepCli, JsonLinesParseAndAddUp) {
  write("d.yaml",
        slowDescriptor("expect: [{metric: crack_count, equals: 0}, {metric: gpu_ms, below: 0.5}]\n"));
  const CallResult result = call({"d.yaml", "--json", "--no-report"});
  EXPECT_EQ(result.exitCode, 1) << "a run of gpu_ms 1.0 breaks the second expectation";
  const auto lines = jsonLines(result.out);
  ASSERT_EQ(lines.size(), 21U);
  std::set<std::string> keys;
  for (size_t i = 0; i < 20; ++i) {
    keys.insert(lines[i]["key"].get<std::string>());
    EXPECT_EQ(lines[i]["status"], "done");
    EXPECT_EQ(lines[i]["technique"], "soft/bitmask");
    EXPECT_EQ(lines[i]["scene"], "grid");
    EXPECT_EQ(lines[i]["error"], "");
    EXPECT_TRUE(lines[i]["measurements"]["gpu_ms"].is_number());
  }
  EXPECT_EQ(keys.size(), 20U);
  const nlohmann::json& summary = lines[20];
  EXPECT_EQ(summary["planned"], 20);
  EXPECT_EQ(summary["done"].get<int>() + summary["skipped"].get<int>() + summary["failed"].get<int>(), 20);
  EXPECT_EQ(summary["store"], "results/d.sqlite");
  ASSERT_EQ(summary["broken"].size(), 1U);
  EXPECT_THAT(summary["broken"][0]["text"].get<std::string>(), HasSubstr("gpu_ms below 0.5"));
}

TEST_F(SweepCli, ExpectationsDecideTheExitCodeAlsoForEarlierRuns) {
  const std::string kept =
      "expect:\n  - {metric: rmse, of: soft/bitmask, below: 0.2}\n"
      "  - {metric: rmse, of: soft/bitmask, where: {samples: 32}, below: 0.7,"
      " relative_to: {of: soft/pcss, where: {radius: 0.05}}}\n";
  write("kept.yaml", validDescriptor() + kept);
  const CallResult held = call({"kept.yaml", "--no-report", "--store", "r.sqlite"});
  EXPECT_EQ(held.exitCode, 0) << held.out << held.err;
  EXPECT_THAT(held.out, HasSubstr("held: rmse of soft/bitmask below 0.2"));
  write("broken.yaml", validDescriptor() + "expect: [{metric: rmse, of: soft/bitmask, below: 0.1}]\n");
  const CallResult broken = call({"broken.yaml", "--no-report", "--store", "r.sqlite"});
  EXPECT_EQ(broken.exitCode, 1);
  EXPECT_THAT(broken.out, AllOf(HasSubstr("0 measured, 10 done before"),
                                HasSubstr("BROKEN: rmse of soft/bitmask below 0.1"), HasSubstr("samples=8"),
                                HasSubstr("0.125")));
}

TEST_F(SweepCli, FailedRunsAreRecordedRetriedAndReported) {
  write("d.yaml",
        "title: a\nquestion: b\nscenes: [{name: grid}]\ntiming: {batch: 1}\n"
        "techniques: [{name: soft/bitmask, samples: [1, 2, 3], fail: [false, true]}]\n");
  const CallResult all = call({"d.yaml", "--no-report", "--store", "all.sqlite"});
  EXPECT_EQ(all.exitCode, 1);
  EXPECT_THAT(all.out,
              AllOf(HasSubstr("FAILED: asked to fail"), HasSubstr("3 measured, 0 done before, 3 failed")));
  EXPECT_THAT(call({"d.yaml", "--no-report", "--store", "all.sqlite"}).out,
              HasSubstr("0 measured, 3 done before, 3 failed"));
  const CallResult fast = call({"d.yaml", "--no-report", "--store", "fast.sqlite", "--fail-fast"});
  EXPECT_EQ(fast.exitCode, 1);
  EXPECT_THAT(fast.out, HasSubstr("1 measured, 0 done before, 1 failed, 4 left"));
}

TEST_F(SweepCli, ShardsMergedEqualTheWhole) {
  write("d.yaml", slowDescriptor("expect: [{metric: crack_count, equals: 0}]\n"));
  ASSERT_EQ(call({"d.yaml", "--no-report", "--store", "whole.sqlite"}).exitCode, 0);
  size_t sum = 0;
  for (const char* part : {"1", "2", "3"}) {
    const auto lines = jsonLines(call({"d.yaml", "--json", "--no-report", "--shard", std::string(part) + "/3",
                                       "--store", std::string(part) + ".sqlite"})
                                     .out);
    sum += lines.back()["planned"].get<size_t>();
  }
  EXPECT_EQ(sum, 20U);
  ASSERT_EQ(call({"merge", "merged.sqlite", "1.sqlite", "2.sqlite", "3.sqlite"}).exitCode, 0);
  const auto content = [&](const std::string& file) {
    const store::Store results(path(file), store::Access::ReadOnly);
    std::vector<std::string> rows;
    for (const store::Run& run : results.runs(results.experiments()[0].id)) {
      std::string row = run.key + run.status + run.label;
      for (const auto& measurement : run.measurements)
        row += measurement.name + std::to_string(*measurement.value);
      rows.push_back(row);
    }
    return rows;
  };
  EXPECT_EQ(content("merged.sqlite").size(), 20U);
  EXPECT_EQ(content("merged.sqlite"), content("whole.sqlite"));
  const CallResult evaluated = call({"d.yaml", "--no-report", "--store", "merged.sqlite"});
  EXPECT_EQ(evaluated.exitCode, 0);
  EXPECT_THAT(evaluated.out, AllOf(HasSubstr("0 measured, 20 done before"), HasSubstr("held: ")));
}

TEST_F(SweepCli, MergeRefusesItsOwnOutput) {
  write("d.yaml", validDescriptor());
  call({"d.yaml", "--no-report", "--store", "a.sqlite"});
  const CallResult result = call({"merge", "a.sqlite", "./a.sqlite"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.err, HasSubstr("into itself"));
}

TEST_F(SweepCli, ReportIsLeftToTheSiblingProgram) {
  write("d.yaml", validDescriptor());
  std::filesystem::copy_file(program_, folder_ / "limen-sweep");
  program_ = path("limen-sweep");
  const CallResult without = call({"d.yaml"});
  EXPECT_EQ(without.exitCode, 0) << "a missing report program is no error";
  EXPECT_THAT(without.out, HasSubstr("no report: limen-report is not built"));
  write("limen-report",
        "#!/bin/sh\necho \"$@\" > arguments\nmkdir -p \"$4\"\necho page > \"$4/report.html\"\n");
  chmod(path("limen-report").c_str(), 0755);
  const CallResult with = call({"d.yaml", "--json"});
  EXPECT_EQ(with.exitCode, 0);
  EXPECT_EQ(jsonLines(with.out).back()["report"], "results/d_report/report.html");
  EXPECT_THAT(read("arguments"), HasSubstr("results/d.sqlite --sweeps -o results/d_report --force"));
  write("limen-report", "#!/bin/sh\nexit 3\n");
  const CallResult failing = call({"d.yaml"});
  EXPECT_EQ(failing.exitCode, 1);
  EXPECT_THAT(failing.err, AllOf(HasSubstr("limen-report ended with 3"), HasSubstr("runs are kept in")));
  EXPECT_THAT(failing.out, HasSubstr("0 measured, 10 done before, 0 failed"));
}

}  // namespace
}  // namespace limen::experiments
