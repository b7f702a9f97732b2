// SPDX-License-Identifier: BSD-3-Clause
#include <set>

#include "tests/experiments/store/store_fixture.h"

namespace limen::store {
namespace {

Run detailedRun(const std::string& key) {
  store::Run run = makeRun(key);
  run.measurements = {{"gpu_ms", 1.0, "ms", "time"}, {"rmse", 0.1, "", "error"}};
  for (int frame = 0; frame < 16; ++frame)
    run.frameTimes.push_back({frame, frame / 8, "frame", 1000 + frame});
  return run;
}

TEST_F(StoreTest, ProcessesThatOpenANewStoreAtOnceAgreeOnIt) {
  std::vector<pid_t> children;
  for (int i = 0; i < 6; ++i)
    children.push_back(startChild([&, i] {
      Store store(path("s.sqlite"), Access::ReadWrite);
      store.claim(makeRun("k" + std::to_string(i)));
    }));
  for (const pid_t child : children) EXPECT_EQ(exitCode(child), 0);
  EXPECT_EQ(Store(path("s.sqlite"), Access::ReadOnly).allRuns().size(), 6U);
}

TEST_F(StoreTest, TwoProcessesThatFinishRunsAtOnceLoseNothingAndShareTheWork) {
  constexpr int kRuns = 300;
  const auto sweep = [&] {
    Store store(path("s.sqlite"), Access::ReadWrite);
    for (int i = 0; i < kRuns; ++i) {
      const store::Run run = detailedRun("k" + std::to_string(i));
      if (store.claim(run) == Store::Claim::Claimed) store.finish(run);
    }
  };
  const pid_t first = startChild(sweep), second = startChild(sweep);
  EXPECT_EQ(exitCode(first), 0);
  EXPECT_EQ(exitCode(second), 0);
  const Store store(path("s.sqlite"), Access::ReadOnly);
  std::set<std::string> keys;
  for (const store::Run& run : store.allRuns(true)) {
    keys.insert(run.key);
    EXPECT_EQ(run.status, "done");
    EXPECT_EQ(run.measurements.size(), 2U);
    EXPECT_EQ(run.frameTimes.size(), 16U);
  }
  EXPECT_EQ(keys.size(), static_cast<size_t>(kRuns));
}

TEST_F(StoreTest, AKilledWriterLosesNothingItCommittedAndLeavesASoundFile) {
  for (int round = 0; round < 5; ++round) {
    const std::string file = path("s" + std::to_string(round) + ".sqlite");
    int done[2];
    ASSERT_EQ(pipe(done), 0);
    const pid_t child = startChild([&] {
      Store store(file, Access::ReadWrite);
      for (int i = 0;; ++i) {
        const store::Run run = detailedRun("k" + std::to_string(i));
        store.claim(run);
        store.finish(run);
        if (write(done[1], &i, sizeof i) != sizeof i) throw Error("pipe");
      }
    });
    close(done[1]);
    int last = -1, value = 0;
    while (last < 20 + 7 * round && read(done[0], &value, sizeof value) == sizeof value) last = value;
    kill(child, SIGKILL);
    exitCode(child);
    while (read(done[0], &value, sizeof value) == sizeof value) last = value;
    close(done[0]);

    EXPECT_EQ(rawSql(file, "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(rawSql(file, "SELECT count(*) FROM pragma_foreign_key_check"), "0");
    Store store(file, Access::ReadWrite);
    for (int i = 0; i <= last; ++i) EXPECT_TRUE(store.isDone("k" + std::to_string(i), "gpu")) << i;
    for (const store::Run& run : store.allRuns(true)) {  // a run is there as a whole or not at all
      EXPECT_EQ(run.measurements.size(), run.status == "done" ? 2U : 0U);
      EXPECT_EQ(run.frameTimes.size(), run.status == "done" ? 16U : 0U);
    }
    EXPECT_NE(store.claim(detailedRun("k" + std::to_string(last + 1))), Store::Claim::HeldByOther)
        << "the killed process holds nothing";
  }
}

}  // namespace
}  // namespace limen::store
