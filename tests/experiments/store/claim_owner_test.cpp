// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/claim_owner.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "experiments/base/process.h"
#include "experiments/store/store.h"
#include "tests/experiments/store/store_fixture.h"

namespace limen::store {
namespace {

using Claim = Store::Claim;

/// Inside task 7 of a job, started for the second time, with a squeue that answers as the test says.
class ClaimOwnerTest : public StoreTest {
 protected:
  void SetUp() override {
    StoreTest::SetUp();
    oldPath_ = std::getenv("PATH");
    setJob("limen", "7", "1");
    squeue("echo RUNNING");
  }
  void TearDown() override {
    for (const char* name : {"SLURM_CLUSTER_NAME", "SLURM_JOB_ID", "SLURM_RESTART_COUNT"}) unsetenv(name);
    setenv("PATH", oldPath_.c_str(), 1);
    StoreTest::TearDown();
  }

  static void setJob(const char* cluster, const char* job, const char* restarts) {
    setenv("SLURM_CLUSTER_NAME", cluster, 1);
    setenv("SLURM_JOB_ID", job, 1);
    setenv("SLURM_RESTART_COUNT", restarts, 1);
  }

  /// Replaces squeue by a script.
  void squeue(const std::string& script) {
    const std::string file = path("squeue");
    std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
    chmod(file.c_str(), 0755);
    setenv("PATH", (path("") + ":" + oldPath_).c_str(), 1);
  }

  std::string oldPath_;
};

TEST_F(ClaimOwnerTest, AnEarlierIncarnationOfTheJobHasEndedOnWhateverHostItWas) {
  EXPECT_EQ(stateOfOwner("elsewhere.example:17:4711 slurm:limen:7:0"), OwnerState::Ended);
  EXPECT_EQ(stateOfOwner(claimOwner()), OwnerState::Alive);
}

TEST_F(ClaimOwnerTest, AnotherHostOfTheSameIncarnationIsNotJudged) {
  EXPECT_EQ(stateOfOwner("elsewhere.example:17:4711 slurm:limen:7:1"), OwnerState::Unknown);
  EXPECT_EQ(stateOfOwner("elsewhere.example:17:4711"), OwnerState::Unknown) << "in no job";
}

TEST_F(ClaimOwnerTest, AProcessThatIsGoneHasDiedInItsOwnJobAndEndedWithAnother) {
  const std::string gone = processIdentity().substr(0, processIdentity().rfind(':')) + ":1";
  EXPECT_EQ(stateOfOwner(gone + " slurm:limen:7:1"), OwnerState::Died);
  EXPECT_EQ(stateOfOwner(gone + " slurm:limen:6:0"), OwnerState::Ended);
}

TEST_F(ClaimOwnerTest, SlurmSaysWhetherOtherJobsStillExist) {
  EXPECT_EQ(stateOfOwner("elsewhere.example:17:4711 slurm:limen:101:0"), OwnerState::Alive);
  squeue("echo COMPLETED");
  EXPECT_EQ(stateOfOwner("elsewhere.example:17:4711 slurm:limen:102:0"), OwnerState::Ended);
  squeue("echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
  EXPECT_EQ(stateOfOwner("elsewhere.example:17:4711 slurm:limen:103:0"), OwnerState::Ended);
  squeue("echo 'Unable to contact slurm controller' >&2; exit 1");
  EXPECT_EQ(stateOfOwner("elsewhere.example:17:4711 slurm:limen:104:0"), OwnerState::Unknown);
}

TEST_F(ClaimOwnerTest, ARequeuedJobTakesOverAtOnceAndCountsNoDeath) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  store.claim(makeRun("k"));
  rawSql(store.path(), "UPDATE run SET owner = 'elsewhere.example:17:4711 slurm:limen:7:0'");
  EXPECT_EQ(store.claim(makeRun("k")), Claim::Claimed);
  EXPECT_EQ(store.deaths("k", makeRun("k").device), 0)
      << "its node may have crashed; the run is not to blame";
}

TEST_F(ClaimOwnerTest, ADeathWithinTheJobCountsEvenAfterItWasStartedAnew) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  store.claim(makeRun("k"));
  const std::string gone = processIdentity().substr(0, processIdentity().rfind(':')) + ":1";
  rawSql(store.path(), "UPDATE run SET owner = '" + gone + " slurm:limen:7:1'");
  EXPECT_EQ(store.claim(makeRun("k")), Claim::Claimed);
  EXPECT_EQ(store.deaths("k", makeRun("k").device), 1);
  rawSql(store.path(), "UPDATE run SET owner = '" + gone + " slurm:limen:7:0'");
  EXPECT_EQ(store.claim(makeRun("k")), Claim::Claimed);
  EXPECT_EQ(store.deaths("k", makeRun("k").device), 1) << "neither forgotten nor counted again";
}

}  // namespace
}  // namespace limen::store
