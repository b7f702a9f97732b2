// SPDX-License-Identifier: BSD-3-Clause
#include "tests/experiments/store/store_fixture.h"

namespace limen::store {
namespace {

using testing::HasSubstr;

Experiment makeExperiment(const std::string& hash) {
  Experiment experiment;
  experiment.hash = hash;
  experiment.title = "title of " + hash;
  return experiment;
}

// A run with one picture in the folder of `store`.
Run runWithPicture(const Store& store, const std::string& key, const std::string& file,
                   const std::string& content, const std::string& device = "gpu") {
  store::Run run = makeRun(key, device);
  writeFile(std::filesystem::path(store.path()).parent_path() / file, content);
  run.artefacts = {{"product_png", file, sha256(content)}};
  return run;
}

class MergeTest : public StoreTest {
 protected:
  std::string left_ = "left/s.sqlite", right_ = "right/s.sqlite";
};

TEST_F(MergeTest, RunsOfBothStoresComeTogetherWithAllTheyHave) {
  Store left(path(left_), Access::ReadWrite), right(path(right_), Access::ReadWrite);
  addDone(left, makeRun("a"));
  store::Run run = runWithPicture(right, "b", "pictures/b.png", "content");
  run.measurements = {{"gpu_ms", 2.5, "ms", "time"}};
  run.frameTimes = {{0, 0, "frame", 7}};
  run.passes = {{"shade", 5}};
  right.putEnvironment({"padding, so that row ids differ", false, {}});
  run.environment = right.putEnvironment({"gpu of b", true, {{"cpu", "x"}}});
  addDone(right, run);

  EXPECT_EQ(left.merge(right), 1);
  const std::vector<store::Run> runs = left.allRuns(true);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[1].key, "b");
  EXPECT_EQ(runs[1].measurements[0].value, 2.5);
  EXPECT_EQ(runs[1].frameTimes[0].nanoseconds, 7);
  EXPECT_EQ(runs[1].passes[0].bytesHeld, 5);
  EXPECT_EQ(left.environment(runs[1].environment).device, "gpu of b");
  EXPECT_EQ(readFile(folder_ / "left" / runs[1].artefacts[0].path), "content");
  EXPECT_EQ(left.merge(right), 0) << "a second merge finds nothing new";
}

TEST_F(MergeTest, DoneBeatsFailedAndTheFirstDoneStays) {
  Store left(path(left_), Access::ReadWrite), right(path(right_), Access::ReadWrite);
  const auto add = [](Store& store, const std::string& key, const std::string& status, double ms) {
    store::Run run = makeRun(key);
    run.status = status;
    run.measurements = {{"gpu_ms", ms, "ms", "time"}};
    addDone(store, run);
  };
  add(left, "failed here", "failed", 1);
  add(right, "failed here", "done", 2);
  add(left, "failed there", "done", 1);
  add(right, "failed there", "failed", 2);
  add(left, "done in both", "done", 1);
  add(right, "done in both", "done", 2);
  add(right, "failed, new", "failed", 2);
  right.claim(makeRun("still running"));

  EXPECT_EQ(left.merge(right), 2);
  std::map<std::string, std::pair<std::string, double>> found;
  for (const store::Run& run : left.allRuns())
    found[run.key] = {run.status, run.measurements.at(0).value.value()};
  const std::map<std::string, std::pair<std::string, double>> expected{{"failed here", {"done", 2.0}},
                                                                       {"failed there", {"done", 1.0}},
                                                                       {"done in both", {"done", 1.0}},
                                                                       {"failed, new", {"failed", 2.0}}};
  EXPECT_EQ(found, expected);
}

TEST_F(MergeTest, TheSameKeyOnTwoDevicesIsKeptTwice) {
  Store left(path(left_), Access::ReadWrite), right(path(right_), Access::ReadWrite);
  addDone(left, makeRun("a", "gpu 1"));
  addDone(right, makeRun("a", "gpu 1"));
  addDone(right, makeRun("a", "gpu 2"));
  EXPECT_EQ(left.merge(right), 1);
  EXPECT_EQ(left.allRuns().size(), 2U);
}

TEST_F(MergeTest, ExperimentsKeepTheirPlansAndSharedOnesAreJoined) {
  Store left(path(left_), Access::ReadWrite), right(path(right_), Access::ReadWrite);
  left.putExperiment(makeExperiment("only left"), {{"z", "t", "s", ""}});
  const int64_t shared = left.putExperiment(makeExperiment("shared"), {{"a", "t", "s", ""}});
  const int64_t there =
      right.putExperiment(makeExperiment("shared"), {{"a", "t", "s", ""}, {"b", "t", "s", "x"}});
  right.putExperiment(makeExperiment("only right"), {{"y", "t", "s", ""}});
  left.putExpectations(shared, {{"e1", true, ""}, {"e2", true, ""}, {"e3", false, "left"}});
  right.putExpectations(there, {{"e1", true, ""}, {"e2", false, "right"}, {"e3", false, "right"}});
  left.merge(right);
  ASSERT_EQ(left.experiments().size(), 3U);
  EXPECT_EQ(left.experiments()[2].title, "title of only right");
  ASSERT_EQ(left.plan(shared).size(), 2U);
  EXPECT_EQ(left.plan(shared)[1].label, "x");
  const std::vector<Expectation> expectations = left.expectations(shared);
  ASSERT_EQ(expectations.size(), 3U);
  EXPECT_TRUE(expectations[0].held);
  EXPECT_FALSE(expectations[1].held) << "broken in one shard is broken";
  EXPECT_EQ(expectations[1].detail, "right");
  EXPECT_EQ(expectations[2].detail, "left; right");
}

TEST_F(MergeTest, FilesOfTheSameNameDoNotOverwriteEachOther) {
  Store left(path(left_), Access::ReadWrite), right(path(right_), Access::ReadWrite);
  addDone(left, runWithPicture(left, "key_a", "product.png", "A"));
  addDone(right, runWithPicture(right, "key_b", "product.png", "B"));
  addDone(right, runWithPicture(right, "key_b", "product.png", "B", "second device"));
  left.merge(right);
  std::map<std::string, std::string> contents;
  for (const store::Run& run : left.allRuns()) {
    const std::string file = run.artefacts.at(0).path;
    contents[run.key] = readFile(folder_ / "left" / file);
    EXPECT_THAT(file, HasSubstr(run.key == "key_b" ? "key_b" : "product"));
  }
  EXPECT_EQ(contents, (std::map<std::string, std::string>{{"key_a", "A"}, {"key_b", "B"}}));
}

TEST_F(MergeTest, EqualFilesOfTheSameNameAreShared) {
  Store left(path(left_), Access::ReadWrite), right(path(right_), Access::ReadWrite);
  addDone(left, runWithPicture(left, "a", "reference.png", "R"));
  addDone(right, runWithPicture(right, "b", "reference.png", "R"));
  left.merge(right);
  EXPECT_EQ(left.allRuns()[1].artefacts[0].path, "reference.png");
}

TEST_F(MergeTest, FilesAreFurtherNamesOnlyIfAsked) {
  Store left(path(left_), Access::ReadWrite), right(path(right_), Access::ReadWrite);
  addDone(left, runWithPicture(left, "a", "product.png", "A"));
  addDone(right, runWithPicture(right, "b", "product.png", "B"));
  EXPECT_EQ(left.merge(right, Store::Files::Shared), 1);
  const std::string shared = path("left/" + left.allRuns().at(1).artefacts.at(0).path);
  EXPECT_EQ(readFile(shared), "B");
  EXPECT_EQ(readFile(path("left/product.png")), "A");
  EXPECT_TRUE(std::filesystem::equivalent(shared, path("right/product.png")));

  Store third(path("third/s.sqlite"), Access::ReadWrite);
  EXPECT_EQ(third.merge(right), 1);
  EXPECT_EQ(readFile(path("third/product.png")), "B");
  EXPECT_FALSE(std::filesystem::equivalent(path("third/product.png"), path("right/product.png")));
}

TEST_F(MergeTest, FilesThatCannotBeSharedAreCopied) {
  // Another file system.
  std::string pattern = "/dev/shm/limen_store_XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr) GTEST_SKIP() << "/dev/shm is not there";
  {
    Store left(path(left_), Access::ReadWrite), right(pattern + "/s.sqlite", Access::ReadWrite);
    addDone(right, runWithPicture(right, "b", "product.png", "B"));
    EXPECT_EQ(left.merge(right, Store::Files::Shared), 1);
  }
  std::filesystem::remove_all(pattern);
  EXPECT_EQ(readFile(path("left/product.png")), "B");
}

TEST_F(MergeTest, DamagedMissingAndEscapingFilesAreRefused) {
  Store left(path(left_), Access::ReadWrite), right(path(right_), Access::ReadWrite);
  addDone(right, runWithPicture(right, "b", "product.png", "B"));
  writeFile(folder_ / "right/product.png", "changed");
  EXPECT_THAT(errorOf([&] { left.merge(right); }), HasSubstr("SHA-256 differs"));
  EXPECT_THAT(errorOf([&] { left.merge(right, Store::Files::Shared); }), HasSubstr("SHA-256 differs"));
  std::filesystem::remove(folder_ / "right/product.png");
  EXPECT_THAT(errorOf([&] { left.merge(right); }), HasSubstr("is missing"));
  rawSql(right.path(), "UPDATE artefact SET path = '../outside.png'");
  writeFile(folder_ / "outside.png", "B");
  EXPECT_THAT(errorOf([&] { left.merge(right); }), HasSubstr("leaves the store's folder"));
  EXPECT_TRUE(left.allRuns().empty());
}

TEST_F(MergeTest, AStoreIsNotMergedIntoItself) {
  Store left(path(left_), Access::ReadWrite);
  const Store again(path("left/../left/s.sqlite"), Access::ReadOnly);
  EXPECT_THAT(errorOf([&] { left.merge(again); }), HasSubstr("itself"));
}

TEST_F(MergeTest, MoreRunsThanATransactionTakesAllArrive) {
  Store left(path(left_), Access::ReadWrite), right(path(right_), Access::ReadWrite);
  for (int i = 0; i < 150; ++i) addDone(right, makeRun("k" + std::to_string(i)));
  EXPECT_EQ(left.merge(right), 150);
  EXPECT_EQ(left.allRuns().size(), 150U);
}

TEST_F(StoreTest, MergesAtOnceIntoOneStoreLoseNothing) {
  constexpr int kInputs = 4, kRuns = 40;
  for (int round = 0; round < 6; ++round) {
    const std::string name = "round" + std::to_string(round) + "/";
    std::filesystem::create_directories(path(name));
    // Shards of one experiment: the plan of the result has the runs of all. Two of them have the same
    // picture.
    for (int i = 0; i < kInputs; ++i) {
      Store store(path(name + std::to_string(i) + ".sqlite"), Access::ReadWrite);
      Experiment experiment;
      experiment.hash = "h";
      experiment.title = "t";
      std::vector<PlanEntry> plan;
      for (int k = 0; k < kRuns; ++k) {
        store::Run run = makeRun("k" + std::to_string(i) + "_" + std::to_string(k));
        plan.push_back({run.key, run.technique, run.scene, run.label});
        const std::string file = "artefacts/" + std::to_string(k) + ".png",
                          text(100000, static_cast<char>('a' + k % 20));
        std::filesystem::create_directories(path(name + "artefacts"));
        writeFile(path(name + file), text);
        run.artefacts = {{"product_png", file, sha256(text)}};
        addDone(store, run);
      }
      store.putExperiment(experiment, plan, {});
    }
    std::filesystem::create_directories(path(name + "out"));
    std::vector<pid_t> children;
    for (int i = 0; i < kInputs; ++i)
      children.push_back(startChild([&, i] {
        const Store from(path(name + std::to_string(i) + ".sqlite"), Access::ReadOnly);
        Store to(path(name + "out/s.sqlite"), Access::ReadWrite);
        to.merge(from);
      }));
    for (const pid_t child : children) EXPECT_EQ(exitCode(child), 0);
    const Store merged(path(name + "out/s.sqlite"), Access::ReadOnly);
    EXPECT_EQ(merged.allRuns().size(), static_cast<size_t>(kInputs * kRuns));
    ASSERT_EQ(merged.experiments().size(), 1U);
    EXPECT_EQ(merged.plan(merged.experiments()[0].id).size(), static_cast<size_t>(kInputs * kRuns));
    for (const store::Run& run : merged.allRuns())
      EXPECT_EQ(sha256File(path(name + "out/" + run.artefacts.at(0).path)), run.artefacts[0].sha256);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path(name + "out")))
      EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path();
  }
}

}  // namespace
}  // namespace limen::store
