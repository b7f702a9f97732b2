// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "tests/experiments/store/store_fixture.h"

namespace limen::store {
namespace {

Experiment describedExperiment(const std::string& hash) {
  Experiment experiment;
  experiment.hash = hash;
  experiment.path = "shadows.yaml";
  experiment.title = "Schatten <hart & weich> \"größer\"";
  experiment.question = "Which one?";
  experiment.source = "section 4.2";
  experiment.descriptor = "title: x\n";
  experiment.features = {"SS-12", "SS-13"};
  experiment.report = {{"x", "gpu_ms"}, {"y", "rmse"}};
  return experiment;
}

TEST_F(StoreTest, EverythingOfARunComesBack) {
  store::Run run = makeRun("k1");
  run.sceneFacts = {{"triangles", 12}};
  run.measurements = {{"gpu_ms", 1.25, "ms", "time"},
                      {"rmse", 0.0, "", "error"},
                      {"psnr", std::numeric_limits<double>::infinity(), "dB", "error"},
                      {"jnd", std::nullopt, "JND", "error"},
                      {"speedup", std::nan(""), "", "fact"}};
  run.frameTimes = {{0, 0, "frame", 1'250'000}, {0, 0, "shade", 1'000'000}, {1, 1, "frame", 5'000'000'000}};
  run.passes = {{"shade", 4096}, {"gbuffer", int64_t{5} << 32}};
  run.artefacts = {{"product_png", "pictures/k1.png", std::string(64, 'a')}};
  {
    Store store(path("s.sqlite"), Access::ReadWrite);
    run.environment = store.putEnvironment({"llvmpipe", true, {{"cpu", "x"}}});
    addDone(store, run);
  }
  const Store store(path("s.sqlite"), Access::ReadOnly);
  const std::vector<store::Run> runs = store.allRuns(true);
  ASSERT_EQ(runs.size(), 1U);
  const store::Run& back = runs[0];
  EXPECT_EQ(back.key, run.key);
  EXPECT_EQ(back.device, run.device);
  EXPECT_EQ(back.status, "done");
  EXPECT_EQ(back.technique, run.technique);
  EXPECT_EQ(back.scene, run.scene);
  EXPECT_EQ(back.label, run.label);
  EXPECT_EQ(back.parameters, run.parameters);
  EXPECT_EQ(back.sceneFacts, run.sceneFacts);
  EXPECT_EQ(back.owner, "");
  EXPECT_EQ(back.started.size(), std::string("2024-01-01T00:00:00.000Z").size());
  EXPECT_LE(back.started, back.finished);
  ASSERT_EQ(back.measurements.size(), 5U);
  EXPECT_EQ(back.measurements[0].name, "gpu_ms");  // the order of writing, not of names
  EXPECT_EQ(back.measurements[0].value, 1.25);
  EXPECT_EQ(back.measurements[0].kind, "time");
  EXPECT_EQ(back.measurements[1].value, 0.0);
  EXPECT_TRUE(std::isinf(back.measurements[2].value.value()));
  EXPECT_FALSE(back.measurements[3].value);
  EXPECT_FALSE(back.measurements[4].value);
  ASSERT_EQ(back.frameTimes.size(), 3U);
  EXPECT_EQ(back.frameTimes[2].nanoseconds, 5'000'000'000);
  EXPECT_EQ(back.frameTimes[2].round, 1);
  ASSERT_EQ(back.passes.size(), 2U);
  EXPECT_EQ(back.passes[0].name, "shade");
  EXPECT_EQ(back.passes[1].bytesHeld, int64_t{5} << 32);
  ASSERT_EQ(back.artefacts.size(), 1U);
  EXPECT_EQ(back.artefacts[0].path, "pictures/k1.png");
  EXPECT_TRUE(store.environment(back.environment).software);
  EXPECT_EQ(store.environment(back.environment).facts.at("cpu"), "x");
  EXPECT_TRUE(store.allRuns()[0].frameTimes.empty());
}

TEST_F(StoreTest, RunsOfAnExperimentComeInPlanOrderUnderItsLabels) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  const int64_t id =
      store.putExperiment(describedExperiment("h1"),
                          {{"b", "t", "s", "first"}, {"missing", "t", "s", "gone"}, {"a", "t", "s", "last"}});
  addDone(store, makeRun("a"));
  addDone(store, makeRun("b"));
  addDone(store, makeRun("of another experiment"));
  const std::vector<store::Run> runs = store.runs(id);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].key, "b");
  EXPECT_EQ(runs[0].label, "first");
  EXPECT_EQ(runs[1].key, "a");
  EXPECT_EQ(store.plan(id)[1].label, "gone");
}

TEST_F(StoreTest, AnExperimentWithTheSameHashKeepsItsRowAndGetsTheNewPlan) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  const int64_t id = store.putExperiment(describedExperiment("h1"), {{"a", "t", "s", ""}, {"b", "t", "s", ""}});
  EXPECT_NE(store.putExperiment(describedExperiment("h2"), {}), id);
  EXPECT_EQ(store.putExperiment(describedExperiment("h1"), {{"c", "t", "s", ""}}), id);
  ASSERT_EQ(store.plan(id).size(), 1U);
  EXPECT_EQ(store.plan(id)[0].key, "c");
  const std::vector<Experiment> experiments = store.experiments();
  ASSERT_EQ(experiments.size(), 2U);
  EXPECT_EQ(experiments[0].title, describedExperiment("").title);
  EXPECT_EQ(experiments[0].features, describedExperiment("").features);
  EXPECT_EQ(experiments[0].report, describedExperiment("").report);
}

TEST_F(StoreTest, ExpectationsAreReplacedAsAWhole) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  const int64_t id = store.putExperiment(describedExperiment("h1"), {});
  store.putExpectations(id, {{"rmse < 1", true, ""}, {"rmse < 0.1", false, "run k has 0.2"}});
  store.putExpectations(id, {{"rmse < 0.5", false, "0.7"}});
  const std::vector<Expectation> back = store.expectations(id);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].text, "rmse < 0.5");
  EXPECT_FALSE(back[0].held);
}

TEST_F(StoreTest, EqualEnvironmentsShareARow) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  const int64_t first = store.putEnvironment({"gpu", false, {{"driver", 1}, {"cpu", "x"}}});
  EXPECT_EQ(store.putEnvironment({"gpu", false, {{"cpu", "x"}, {"driver", 1}}}), first);
  EXPECT_NE(store.putEnvironment({"gpu", false, {{"driver", 2}, {"cpu", "x"}}}), first);
  EXPECT_NE(store.putEnvironment({"gpu", true, {{"driver", 1}, {"cpu", "x"}}}), first);
  EXPECT_EQ(store.environments().size(), 3U);
}

TEST_F(StoreTest, BytesThatAreNoUtf8DoNotStopARun) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  store::Run run = makeRun("k");
  run.parameters = {{"technique", {{"file", "caf\xe9.obj"}}}};
  addDone(store, run);
  EXPECT_EQ(store.allRuns().size(), 1U);
}

}  // namespace
}  // namespace limen::store
