// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include "tests/experiments/cli_fixture.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// No program can be found.
class SubmitWithoutSlurm : public SweepCli {
 protected:
  void SetUp() override {
    SweepCli::SetUp();
    setenv("PATH", folder_.c_str(), 1);
    write("d.yaml", validDescriptor());
  }
};

TEST_F(SubmitWithoutSlurm, TheErrorNamesThePackageAndTheScriptsArePrinted) {
  const CallResult result = call({"submit", "d.yaml", "--array", "4"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("sbatch"), HasSubstr("slurm-client")));
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("exec \"$@\""), HasSubstr("--array=1-2"), HasSubstr("afterany:ARRAY")));
}

TEST_F(SubmitWithoutSlurm, ADryRunPrintsTheScriptsAndWritesNothing) {
  const CallResult result = call({"submit", "d.yaml", "--array", "4%2", "--dry-run", "--", "--gres=gpu:1"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("sbatch --gres=gpu:1"), HasSubstr("--array=1-2%2"),
                                HasSubstr("10 of 10 runs in 2 tasks")));
  EXPECT_FALSE(exists("results"));
}

TEST_F(SubmitWithoutSlurm, BadInputIsRefusedBeforeAnythingIsWritten) {
  EXPECT_THAT(call({"submit", "d.yaml"}).err, HasSubstr("--array"));
  EXPECT_THAT(call({"submit", "d.yaml", "--array", "x"}).err, HasSubstr("--array 64%8"));
  EXPECT_THAT(call({"submit", "d.yaml", "--array", "4", "--", "--wrap=ls"}).err,
              HasSubstr("set by limen submit"));
  EXPECT_THAT(call({"submit", "none.yaml", "--array", "4"}).err, HasSubstr("none.yaml"));
  EXPECT_FALSE(exists("results"));
}

TEST_F(SubmitWithoutSlurm, StatusReadsAStoreThatWasNeverSubmitted) {
  ASSERT_EQ(call({"d.yaml", "--no-report"}).exitCode, 0);
  EXPECT_THAT(call({"status", "d.yaml"}).out, HasSubstr("10 planned, 10 done, 0 running, 0 failed, 0 left"));
  EXPECT_THAT(call({"status", "results/none.sqlite"}).err, HasSubstr("no such result store"));
}

}  // namespace
}  // namespace limen::experiments
