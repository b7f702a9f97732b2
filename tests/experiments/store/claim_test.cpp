// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/process.h"
#include "tests/experiments/store/store_fixture.h"

namespace limen::store {
namespace {

using Claim = Store::Claim;

std::string sql(const std::string& owner) { return "UPDATE run SET owner = '" + owner + "'"; }

TEST_F(StoreTest, AFreshCellIsClaimedOnceAndDoneOnce) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  const store::Run run = makeRun("k");
  EXPECT_FALSE(store.isDone("k", "gpu"));
  EXPECT_EQ(store.claim(run), Claim::Claimed);
  EXPECT_FALSE(store.isDone("k", "gpu"));
  EXPECT_EQ(store.allRuns()[0].status, "running");
  EXPECT_EQ(store.allRuns()[0].owner, processIdentity());
  store.finish(run);
  EXPECT_TRUE(store.isDone("k", "gpu"));
  EXPECT_FALSE(store.isDone("k", "other gpu"));
  EXPECT_EQ(store.claim(run), Claim::AlreadyDone);
  EXPECT_EQ(store.claim(makeRun("k", "other gpu")), Claim::Claimed);
}

TEST_F(StoreTest, AFailedRunIsTakenOverAndLosesItsOldDetails) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  store::Run run = makeRun("k");
  run.status = "failed";
  run.error = "non-finite";
  run.measurements = {{"gpu_ms", 3.0, "ms", "time"}};
  addDone(store, run);
  EXPECT_FALSE(store.isDone("k", "gpu"));
  EXPECT_EQ(store.allRuns()[0].error, "non-finite");
  EXPECT_EQ(store.claim(run), Claim::Claimed);
  EXPECT_TRUE(store.allRuns()[0].measurements.empty());
  EXPECT_EQ(store.allRuns()[0].error, "");
}

TEST_F(StoreTest, ALiveProcessKeepsItsClaim) {
  const std::string file = path("s.sqlite");
  int ready[2], go[2];
  ASSERT_EQ(pipe(ready), 0);
  ASSERT_EQ(pipe(go), 0);
  const pid_t child = startChild([&] {
    Store store(file, Access::ReadWrite);
    if (store.claim(makeRun("k")) != Claim::Claimed) throw Error("not claimed");
    char byte = 0;
    if (write(ready[1], &byte, 1) != 1 || read(go[0], &byte, 1) != 1) throw Error("pipe");
  });
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  Store store(file, Access::ReadWrite);
  EXPECT_EQ(store.claim(makeRun("k")), Claim::HeldByOther);
  EXPECT_EQ(store.claim(makeRun("k"), 0.0), Claim::HeldByOther) << "age does not matter on the same host";
  ASSERT_EQ(write(go[1], &byte, 1), 1);
  EXPECT_EQ(exitCode(child), 0);
  EXPECT_EQ(store.claim(makeRun("k")), Claim::Claimed) << "the owner has ended without finishing";
}

TEST_F(StoreTest, AKilledOwnerIsNoticedEvenWhileItIsAZombie) {
  const std::string file = path("s.sqlite");
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = startChild([&] {
    Store store(file, Access::ReadWrite);
    store.claim(makeRun("k"));
    char byte = 0;
    if (write(ready[1], &byte, 1) != 1) throw Error("pipe");
    pause();
  });
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  kill(child, SIGKILL);
  siginfo_t info{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT), 0);
  Store store(file, Access::ReadWrite);
  EXPECT_EQ(store.claim(makeRun("k")), Claim::Claimed);
  exitCode(child);
}

TEST_F(StoreTest, AReusedProcessIdIsNotTheOwner) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  store.claim(makeRun("k"));
  // This very process, but started at another time.
  std::string owner = processIdentity();
  owner = owner.substr(0, owner.rfind(':')) + ":1";
  rawSql(store.path(), sql(owner));
  EXPECT_EQ(store.claim(makeRun("k")), Claim::Claimed);
}

TEST_F(StoreTest, AClaimFromAnotherHostDiesOfAge) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  store.claim(makeRun("k"));
  rawSql(store.path(), sql("elsewhere.example:17:4711"));
  EXPECT_EQ(store.claim(makeRun("k")), Claim::HeldByOther);
  rawSql(store.path(), "UPDATE run SET started = strftime('%Y-%m-%dT%H:%M:%fZ', 'now', '-50 minutes')");
  EXPECT_EQ(store.claim(makeRun("k")), Claim::HeldByOther) << "50 minutes are less than the hour";
  rawSql(store.path(), "UPDATE run SET started = strftime('%Y-%m-%dT%H:%M:%fZ', 'now', '-70 minutes')");
  EXPECT_EQ(store.claim(makeRun("k")), Claim::Claimed);
}

TEST_F(StoreTest, FinishingARunThatSomebodyTookOverIsAnError) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  store.claim(makeRun("k"));
  rawSql(store.path(), sql("elsewhere.example:17:4711"));
  EXPECT_THAT(errorOf([&] { store.finish(makeRun("k")); }), testing::HasSubstr("no longer held"));
  EXPECT_EQ(store.allRuns()[0].status, "running");
}

TEST_F(StoreTest, ReleasedClaimsAreFreeAndFinishedRunsStay) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  addDone(store, makeRun("done"));
  store.claim(makeRun("open"));
  store.claim(makeRun("foreign"));
  rawSql(store.path(), sql("elsewhere.example:17:4711") + " WHERE key = 'foreign'");
  store.releaseClaims();
  std::vector<std::string> keys;
  for (const store::Run& run : store.allRuns()) keys.push_back(run.key);
  EXPECT_THAT(keys, testing::ElementsAre("done", "foreign"));
}

TEST(ProcessIdentity, StaysTheSameInAProcessAndDiffersInAChild) {
  const std::string own = processIdentity();
  EXPECT_EQ(own, processIdentity());
  EXPECT_EQ(exitCode(startChild([&] {
              if (processIdentity() == own) throw Error("same identity");
            })),
            0);
}

}  // namespace
}  // namespace limen::store
