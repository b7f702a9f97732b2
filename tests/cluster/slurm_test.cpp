// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cluster/slurm_fixture.h"

namespace limen::experiments {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(SlurmTest, KilledTasksCrashedNodesAndRequeuedJobsLeaveTheStoreOfAnUnsharedSweep) {
  constexpr size_t kMany = 72;
  write("d.yaml", tasksDescriptor(kMany, 250));
  const pid_t unshared = start({"d.yaml", "--store", "whole.sqlite", "--no-report"}, "whole");
  const CallResult submitted = call({"submit", "d.yaml", "--array", "6"});
  ASSERT_EQ(submitted.exitCode, 0) << submitted.err;
  const std::string folder = "results/d_tasks/1";
  ASSERT_TRUE(eventually([&] {
    for (int task = 1; task <= 6; ++task)
      if (finished(folder, task) == 0) return false;
    return true;
  }));

  std::map<int, Listed> tasks;
  for (const Listed& job : queue())
    if (job.index > 0) tasks[job.index] = job;
  ASSERT_EQ(tasks.size(), 6U);
  // A task with everything that belongs to it, as the kernel kills for memory.
  const int killed = 1;
  for (const pid_t id : processes("job task " + path(folder))) {
    const std::string environment = readAny("/proc/" + std::to_string(id) + "/environ");
    if (environment.find(std::string("SLURM_ARRAY_TASK_ID=1\0", 22)) == std::string::npos) continue;
    for (const pid_t child : processes("--parent=" + std::to_string(id))) kill(child, SIGKILL);
    kill(id, SIGKILL);
  }
  for (const pid_t id : processes("job measure " + path(folder) + " --task=1 ")) kill(id, SIGKILL);
  // Another node, whose tasks start anew elsewhere.
  std::string node;
  for (const auto& [index, job] : tasks)
    if (job.node != tasks[killed].node) node = job.node;
  ASSERT_FALSE(node.empty());
  ASSERT_EQ(slurm({"crash", cluster_, node}).status, 0);
  // And one that is neither is asked to start anew.
  for (const auto& [index, job] : tasks)
    if (index != killed && job.node != node) {
      EXPECT_EQ(runAndRead({"scontrol", "requeue", job.job}).status, 0);
      break;
    }
  // A node that comes back before it is missed is asked for its jobs only after half a minute.
  ASSERT_TRUE(eventually([&] {
    for (const Listed& job : queue())
      if (job.node == node && job.state == "RUNNING") return false;
    return true;
  }));
  ASSERT_EQ(slurm({"revive", cluster_, node}).status, 0);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(eventually(allOver));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(45))
      << "nobody waits for claims of the dead to grow old";

  ASSERT_EQ(wait(unshared, "whole").exitCode, 0);
  const auto expected = hashes(path("whole.sqlite"));
  EXPECT_EQ(expected.size(), kMany);
  EXPECT_EQ(hashes(path("results/d.sqlite")), expected);
  EXPECT_TRUE(exists("results/d_report/report.html"));
  bool again = false;
  for (const Listed& job : queue()) again = again || (job.index == killed && job.state == "FAILED");
  EXPECT_TRUE(again) << "the killed task should have been lost for Slurm, and its runs submitted again";
  EXPECT_TRUE(exists("results/d_tasks/2/merge.log"));
}

TEST_F(SlurmTest, WhatFailsIsSaidByStatusAndReportAndNotRepeated) {
  write("d.yaml",
        tasksDescriptor(8, 1, "  - {name: soft/pcss, fail: true}\n  - {name: soft/pcss, die: true}\n"));
  ASSERT_EQ(call({"submit", "d.yaml", "--array", "3"}).exitCode, 0);
  ASSERT_TRUE(eventually(allOver));
  const CallResult status = call({"status", "d.yaml"});
  EXPECT_THAT(status.out, AllOf(HasSubstr("12 planned, 8 done, 0 running, 4 failed, 0 left"),
                                HasSubstr("asked to fail"), HasSubstr("died twice")));
  const std::string log = read("results/d_tasks/1/merge.log");
  EXPECT_THAT(log, AllOf(HasSubstr("8 measured"), HasSubstr("4 failed"), HasSubstr("asked to fail")));
  EXPECT_THAT(read("results/d_report/report.html"), HasSubstr("asked to fail"));
  EXPECT_FALSE(exists("results/d_tasks/2")) << "a failed run is no run that was left behind";
}

/// Runs take .3 s each, and two tasks share them: what is said after some is what the rest takes,
/// up to a second of Slurm's own and a third, as tasks write how far they are once a second.
TEST_F(SlurmTest, StatusSaysHowLongTheRestTakes) {
  using std::chrono::steady_clock;
  write("d.yaml", tasksDescriptor(32, 300));
  ASSERT_EQ(call({"submit", "d.yaml", "--array", "2"}).exitCode, 0);
  const auto status = [&] { return nlohmann::json::parse(call({"status", "d.yaml", "--json"}).out); };
  nlohmann::json said;
  ASSERT_TRUE(eventually([&] {
    said = status();
    return said.at("done").get<int>() >= 4 && said.at("running").get<int>() > 0;
  }));
  const auto asked = steady_clock::now();
  ASSERT_TRUE(said.at("seconds_left").is_number()) << said;
  ASSERT_TRUE(eventually([&] { return status().at("done") == 32; }));
  const double took = std::chrono::duration<double>(steady_clock::now() - asked).count();
  EXPECT_NEAR(said.at("seconds_left").get<double>(), took, 1.0 + took / 3.0) << said;
  EXPECT_GT(took, 1.0);
  ASSERT_TRUE(eventually(allOver));
  EXPECT_TRUE(status().at("seconds_left").is_null());
}

TEST_F(SlurmTest, ATaskThatCannotWorkIsTriedElsewhereAndThenReported) {
  write("d.yaml", tasksDescriptor(24, 1));
  setenv("FAKE_DEVICE", "", 1);  // a cluster without a driver
  ASSERT_EQ(call({"submit", "d.yaml", "--array", "2"}).exitCode, 0);
  unsetenv("FAKE_DEVICE");
  ASSERT_TRUE(eventually(allOver));
  EXPECT_TRUE(exists("results/d_tasks/3/merge.log"));
  EXPECT_FALSE(exists("results/d_tasks/4")) << "three attempts";
  EXPECT_THAT(read("results/d_tasks/3/merge.log"),
              AllOf(HasSubstr("24 runs left after 3 attempts"), HasSubstr("ended as FAILED")));
  const CallResult status = call({"status", "d.yaml"});
  EXPECT_THAT(status.out, AllOf(HasSubstr("24 left"), HasSubstr("FAILED on n")));
  // Mended, the same command goes on.
  ASSERT_EQ(call({"submit", "d.yaml", "--array", "2"}).exitCode, 0);
  ASSERT_TRUE(eventually(allOver));
  EXPECT_EQ(hashes(path("results/d.sqlite")).size(), 24U);
}

TEST_F(SlurmTest, AFinishedSweepSubmitsNothingAndAChangedOneWhatIsNew) {
  write("d.yaml", tasksDescriptor(16, 1));
  ASSERT_EQ(call({"submit", "d.yaml", "--array", "2"}).exitCode, 0);
  ASSERT_TRUE(eventually(allOver));
  const CallResult again = call({"submit", "d.yaml", "--array", "2"});
  EXPECT_EQ(again.exitCode, 0);
  EXPECT_THAT(again.out, HasSubstr("nothing to submit: 16 runs done"));
  EXPECT_FALSE(exists("results/d_tasks/2"));

  write("d.yaml", tasksDescriptor(20, 1));
  const CallResult more = call({"submit", "d.yaml", "--array", "8"});
  EXPECT_THAT(more.out, HasSubstr("4 of 20 runs in 2 tasks"));
  ASSERT_TRUE(eventually(allOver));
  EXPECT_EQ(hashes(path("results/d.sqlite")).size(), 20U);
}

TEST_F(SlurmTest, WhatIsInTheQueueIsNotSubmittedAgain) {
  write("d.yaml", tasksDescriptor(16, 100));
  ASSERT_EQ(call({"submit", "d.yaml", "--array", "2"}).exitCode, 0);
  EXPECT_THAT(call({"submit", "d.yaml", "--array", "2"}).out,
              HasSubstr("nothing to submit: 0 runs done, 16 in the queue"));
  write("d.yaml", tasksDescriptor(20, 100));
  EXPECT_THAT(call({"submit", "d.yaml", "--array", "2"}).out, HasSubstr("4 of 20 runs"));
  ASSERT_TRUE(eventually(allOver));
  // The first tasks refused the changed descriptor, or had read it before: nothing is lost either way.
  call({"submit", "d.yaml", "--array", "2"});
  ASSERT_TRUE(eventually(allOver));
  EXPECT_EQ(hashes(path("results/d.sqlite")).size(), 20U);
}

TEST_F(SlurmTest, TasksThatNoJobWouldMergeGetOneWithTheNextSubmit) {
  write("d.yaml", tasksDescriptor(16, 200));
  ASSERT_EQ(call({"submit", "d.yaml", "--array", "2"}).exitCode, 0);
  for (const Listed& job : queue())
    if (job.index == 0) runAndRead({"scancel", job.job});
  EXPECT_THAT(call({"submit", "d.yaml", "--array", "2"}).out,
              AllOf(HasSubstr("is merged by job"), HasSubstr("16 in the queue")));
  ASSERT_TRUE(eventually(allOver));
  EXPECT_EQ(hashes(path("results/d.sqlite")).size(), 16U);
  EXPECT_TRUE(exists("results/d_report/report.html"));
}

TEST_F(SlurmTest, CancelledTasksStayCancelledUntilTheNextSubmit) {
  write("d.yaml", tasksDescriptor(24, 300));
  ASSERT_EQ(call({"submit", "d.yaml", "--array", "2"}).exitCode, 0);
  ASSERT_TRUE(eventually([&] { return finished("results/d_tasks/1", 1) > 0; }));
  for (const Listed& job : queue())
    if (job.index > 0) runAndRead({"scancel", job.job});
  ASSERT_TRUE(eventually(allOver));
  EXPECT_FALSE(exists("results/d_tasks/2"));
  EXPECT_THAT(read("results/d_tasks/1/merge.log"), HasSubstr("cancelled"));
  const size_t before = hashes(path("results/d.sqlite")).size();
  EXPECT_GT(before, 0U) << "what was finished is kept";
  EXPECT_LT(before, 24U);
}

TEST_F(SlurmTest, AnyFileNameReachesTheTasksAsItIs) {
  const std::string folder = "it's \"a\" $(touch pwned) `x` %j; ";
  write(folder + "/d e'.yaml", tasksDescriptor(8, 1));
  const CallResult submitted = call({"submit", folder + "/d e'.yaml", "--store", folder + "/s\"t%A .sqlite",
                                     "--array", "2", "--", "--comment=a 'b' $(touch pwned)"});
  ASSERT_EQ(submitted.exitCode, 0) << submitted.err;
  ASSERT_TRUE(eventually(allOver));
  for (const Listed& job : queue()) EXPECT_EQ(job.state, "COMPLETED") << job.name;
  EXPECT_EQ(hashes(path(folder + "/s\"t%A .sqlite")).size(), 8U);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
    EXPECT_NE(entry.path().filename(), "pwned") << "a shell has read it";
  // What a terminal would obey, and what is no text, is refused before anything is written.
  for (const char* name : {"new\nline.sqlite", "\xff.sqlite", "back\\slash.sqlite"}) {
    const CallResult refused = call({"submit", folder + "/d e'.yaml", "--store", name, "--array", "2"});
    EXPECT_EQ(refused.exitCode, 2) << name;
    EXPECT_FALSE(exists(name)) << name;
  }
}

}  // namespace
}  // namespace limen::experiments
