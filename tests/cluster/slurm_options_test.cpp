// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "experiments/base/error.h"
#include "experiments/slurm.h"

namespace limen::experiments {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string refusal(const std::vector<std::string>& options) {
  try {
    checkSlurmOptions(options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SlurmOptions, ThoseThatSubmitSetsAreRefused) {
  for (const char* option :
       {"--array=1-3", "-a1-3", "--wrap=rm", "--output=x", "-ox", "--dependency=afterok:1", "--job-name=x",
        "-Jx", "--chdir=/", "--no-requeue", "--wait"})
    EXPECT_THAT(refusal({option}), HasSubstr("is set by limen submit")) << option;
}

TEST(SlurmOptions, AWordThatSbatchWouldTakeForAScriptIsRefused) {
  EXPECT_THAT(refusal({"--partition", "gpu"}), HasSubstr("'gpu' is no option"));
  EXPECT_THAT(refusal({"-p"}), HasSubstr("-pgpu")) << "it would take the next of our options for its value";
  EXPECT_THAT(refusal({"--"}), Not(testing::IsEmpty()));
  EXPECT_THAT(refusal({""}), Not(testing::IsEmpty()));
}

TEST(SlurmOptions, OthersPassAsTheyAre) {
  EXPECT_EQ(refusal({"--partition=gpu", "-pgpu", "--gres=gpu:1", "--time=02:00:00", "--mem=8G", "-H",
                     "--comment=it's $(all) one word", "--account=x"}),
            "");
}

TEST(SlurmOptions, AnArrayIsANumberOfTasksAndOfThoseAtOnce) {
  EXPECT_EQ(readArray("64"), std::pair(64, 0));
  EXPECT_EQ(readArray("64%8"), std::pair(64, 8));
  for (const char* text : {"", "0", "-1", "64%", "64%0", "1-64", "64 ", "x"})
    EXPECT_THROW(readArray(text), Error) << text;
}

TEST(SlurmScripts, NoNameIsInAScriptAndEachIsAWordOfTheCall) {
  Submission submission;
  submission.folder = "/a b/$(touch x)%j'\"/s_tasks/1";
  submission.name = "limen_s_1";
  submission.array = "3";
  submission.tasks = 3;
  submission.slurmOptions = {"--comment=`x`"};
  const SlurmJob job = arrayJob(submission);
  EXPECT_THAT(job.script, Not(HasSubstr("touch")));
  EXPECT_THAT(job.call, testing::Contains("--chdir=" + submission.folder));
  EXPECT_THAT(job.call, testing::Contains("--comment=`x`"));
  // %% is how Slurm writes a % in a file's name.
  EXPECT_THAT(job.call, testing::Contains("--output=/a b/$(touch x)%%j'\"/s_tasks/1/task_%a.log"));
  EXPECT_EQ(job.call.back(), submission.folder);
  EXPECT_EQ(mergeJob(submission, "17").script.find("touch"), std::string::npos);
}

}  // namespace
}  // namespace limen::experiments
