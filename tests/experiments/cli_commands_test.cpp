// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <iostream>

#include "tests/experiments/cli_fixture.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(SweepCli, HelpAndVersionSucceed) {
  const CallResult help = call({"--help"});
  EXPECT_EQ(help.exitCode, 0);
  for (const char* option : {"--store", "--shard", "--dry-run", "--list", "--features", "--json",
                             "--fail-fast", "--no-report", "--version", "merge"})
    EXPECT_THAT(help.out, HasSubstr(option));
  const CallResult version = call({"--version"});
  EXPECT_EQ(version.exitCode, 0);
  EXPECT_THAT(version.out, AllOf(HasSubstr("limen-sweep 0."), HasSubstr("commit ")));
}

TEST_F(SweepCli, RefusesBadCommandLines) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "no descriptor"},
      {{"--dryrun", "d.yaml"}, "did you mean '--dry-run'?"},
      {{"--shard", "0/2", "d.yaml"}, "'0/2' is not a shard"},
      {{"--shard", "3/2", "d.yaml"}, "'3/2' is not a shard"},
      {{"--shard", "1/2x", "d.yaml"}, "'1/2x' is not a shard"},
      {{"--list", "soft/bitmsk"}, "did you mean 'soft/bitmask'?"},
      {{"merge"}, "required"},
      {{"merge", "out.sqlite", "missing.sqlite"}, "missing.sqlite"},
      {{"d.yaml", "--list", "scenes"}, "--list"}};
  write("d.yaml", validDescriptor());
  for (const auto& [arguments, word] : cases) {
    const CallResult result = call(arguments);
    EXPECT_EQ(result.exitCode, 2) << word;
    EXPECT_THAT(result.err, HasSubstr(word));
    EXPECT_EQ(result.out, "");
  }
  EXPECT_FALSE(exists("results"));
  EXPECT_FALSE(exists("out.sqlite"));
}

TEST_F(SweepCli, RefusesAStoreThatIsNone) {
  write("d.yaml", validDescriptor());
  write("notes.txt", "these are my notes, not a database\n");
  const CallResult result = call({"d.yaml", "--store", "notes.txt"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.err, HasSubstr("notes.txt"));
  EXPECT_EQ(read("notes.txt"), "these are my notes, not a database\n");
}

TEST_F(SweepCli, AMachineWithoutADeviceFailsWithoutWriting) {
  write("d.yaml", validDescriptor());
  setenv("FAKE_DEVICE", "", 1);
  const CallResult sweep = call({"d.yaml"});
  const CallResult dry = call({"d.yaml", "--dry-run"});
  const CallResult list = call({"--list"});
  unsetenv("FAKE_DEVICE");
  EXPECT_EQ(sweep.exitCode, 2);
  EXPECT_THAT(sweep.err, HasSubstr("no device"));
  EXPECT_FALSE(exists("results"));
  EXPECT_EQ(dry.exitCode, 0);
  EXPECT_EQ(list.exitCode, 0);
}

TEST_F(SweepCli, ListComesFromTheDeclarations) {
  const std::string all = call({"--list"}).out;
  EXPECT_THAT(all, AllOf(HasSubstr("soft/bitmask"), HasSubstr("grid"), HasSubstr("crack_count"),
                         HasSubstr("Sampled light (reference)")));
  const std::string metrics = call({"--list", "metrics"}).out;
  EXPECT_THAT(metrics, AllOf(HasSubstr("rmse"), Not(HasSubstr("soft/bitmask"))));
  const std::string one = call({"--list", "soft/bitmask"}).out;
  EXPECT_THAT(one, AllOf(HasSubstr("samples: whole number from 1 to 100000; default 64"),
                         HasSubstr("one of regular_8, regular_16, jittered_16"), HasSubstr("(m)"),
                         HasSubstr("rectangular_light"), HasSubstr("Test 2024, section 1")));
  const auto lines = jsonLines(call({"--list", "soft/bitmask", "--json"}).out);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0]["parameters"][0]["default"], 64);
}

TEST_F(SweepCli, DryRunPrintsThePlanAndWritesNothing) {
  write("d.yaml", validDescriptor());
  const CallResult text = call({"d.yaml", "--dry-run"});
  EXPECT_EQ(text.exitCode, 0);
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("10 runs: 2 scenes"), HasSubstr("soft/bitmask samples=8, grid light_size=0.5"),
                    HasSubstr("results/d.sqlite")));
  const auto lines = jsonLines(call({"d.yaml", "--dry-run", "--json"}).out);
  ASSERT_EQ(lines.size(), 11U);
  EXPECT_EQ(lines.back()["planned"], 10);
  EXPECT_EQ(lines[0]["parameters"]["technique"]["samples"], 8);
  EXPECT_EQ(lines[0]["parameters"]["reference"]["name"], "soft/sampled");
  EXPECT_FALSE(exists("results"));
}

TEST_F(SweepCli, PlansAThousandRunsQuickly) {
  std::string samples = "[";
  for (int i = 1; i <= 250; ++i) samples += (i == 1 ? "" : ", ") + std::to_string(i);
  // A file is hashed once, however many runs name it.
  write("big.obj", std::string(3 << 20, 'v'));
  write("d.yaml",
        "title: a\nquestion: b\nscenes: [{name: mesh, file: big.obj}, {name: grid}]\n"
        "techniques: [{name: soft/bitmask, samples: " +
            samples +
            "], pattern: [regular_8, regular_16]}]\n"
            "reference: {name: soft/sampled}\nmetrics: [rmse]\n"
            "expect: [{metric: rmse, where: {pattern: regular_8}, below: 2, relative_to: {where: {pattern: "
            "regular_16}}}]\n");
  const auto start = std::chrono::steady_clock::now();
  const CallResult result = call({"d.yaml", "--dry-run"});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << "1,000 runs planned in " << seconds << " s\n";
  EXPECT_THAT(result.out, HasSubstr("1000 runs"));
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_LT(seconds, 2.0);
}

TEST_F(SweepCli, FeaturesAreCountedOverAllDescriptorsOfTheRoot) {
  write("tree/experiments/features.yaml",
        "- {id: SS-01, name: One, source: Test 2024, section: \"1\", kind: contribution}\n"
        "- {id: SS-02, name: Two, source: Test 2024, section: \"2\", kind: comparator}\n"
        "- {id: VF-01, name: Three, source: Test 2024, section: \"3\", kind: background}\n");
  write("tree/experiments/descriptors/shadows/a.yaml", "title: a\nfeatures: [SS-01, VF-01]\n");
  write("tree/experiments/descriptors/b.yaml", "title: b\nfeatures: [SS-01]\n");
  const auto lines = jsonLines(call({"--features", "--json", "--root", "tree"}).out);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0]["descriptors"],
            (nlohmann::json{"experiments/descriptors/b.yaml", "experiments/descriptors/shadows/a.yaml"}));
  EXPECT_EQ(lines[3]["features"], 3);
  EXPECT_EQ(lines[3]["covered"], 2);
  EXPECT_EQ(lines[3]["uncovered"], nlohmann::json{"SS-02"});
  EXPECT_EQ(lines[3]["by_family"]["SS"], (nlohmann::json{{"covered", 1}, {"all", 2}}));
  setenv("LIMEN_ROOT", "tree", 1);
  const CallResult text = call({"--features"});
  unsetenv("LIMEN_ROOT");
  EXPECT_THAT(text.out, HasSubstr("2 of 3 features are covered by 2 descriptors"));
  write("tree/experiments/descriptors/c.yaml", "title: c\nfeatures: [SS-03]\n");
  const CallResult unknown = call({"--features", "--root", "tree"});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_THAT(unknown.err, HasSubstr("c.yaml:2:12"));
}

}  // namespace
}  // namespace limen::experiments
