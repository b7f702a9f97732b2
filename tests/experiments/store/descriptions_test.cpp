// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/store/descriptions.h"

#include "tests/experiments/store/store_fixture.h"

namespace limen::store {
namespace {

Experiment experimentOf(const std::string& hash) {
  Experiment experiment;
  experiment.hash = hash;
  experiment.title = "title of " + hash;
  return experiment;
}

Descriptions rimAndNodes() {
  Descriptions out;
  out.quantities = {
      {"nodes", "Nodes visited", "1/px", Direction::LowerIsBetter, "counter", "", "Test 2024, 2"},
      {"score", "Score", "", Direction::HigherIsBetter, "error", "", ""},
      {"gpu_ms", "GPU time", "ms", Direction::LowerIsBetter, "time", "frame", ""}};
  ParameterRow rim;
  rim.subject = "technique";
  rim.owner = "soft_shadows/bitmask";
  rim.path = "budget.rim";
  rim.when = {{"budget", "radial"}};
  rim.title = "Budget: rim";
  rim.unit = "occluders";
  rim.type = "whole number";
  rim.defaultValue = "25";
  rim.description = "Micro-occluders allowed at the rim";
  rim.source = "Test 2024, 3";
  ParameterRow other = rim;  // the same path, declared by another alternative
  other.when = {{"budget", "elliptic"}};
  other.unit = "px";
  out.parameters = {rim, other};
  return out;
}

// As a sweep of schema 2 left it: one run with a time, two errors and a counter, and no word of what they
// are.
std::string writeSchemaTwo(const std::string& file) {
  {
    Store store(file, Access::ReadWrite);
    store::Run run = makeRun("k");
    run.measurements = {{"gpu_ms", 2.0, "ms", "time"},
                        {"psnr", 30.0, "dB", "error"},
                        {"psnr_like_figure", 1.0, "", "error"},
                        {"tiles_px", 5.0, "px", "counter"}};
    addDone(store, run);
    store.putExperiment(experimentOf("old"), {{"k", run.technique, run.scene, run.label}});
  }
  rawSql(file, "DROP TABLE quantity; DROP TABLE parameter; PRAGMA user_version = 2");
  return file;
}

TEST_F(StoreTest, NamesMeanWhatThePlanSaid) {
  const Descriptions written = rimAndNodes();
  Store store(path("s.sqlite"), Access::ReadWrite);
  const int64_t id = store.putExperiment(experimentOf("e"), {}, written);
  EXPECT_EQ(store.descriptions(id).quantities, written.quantities);
  EXPECT_EQ(store.descriptions(id).parameters, written.parameters);
  store.putExperiment(experimentOf("e"), {}, {{written.quantities[1]}, {}});
  EXPECT_EQ(store.descriptions(id).quantities.size(), 1U) << "a new plan brings its own";
}

TEST_F(StoreTest, AStoreOfSchemaTwoIsReadAsItIs) {
  const std::string file = writeSchemaTwo(path("old.sqlite"));
  const Store store(file, Access::ReadOnly);
  const Descriptions old = store.descriptions(store.experiments().at(0).id);
  ASSERT_NE(old.quantity("psnr"), nullptr);
  EXPECT_EQ(old.quantity("psnr")->title, "PSNR");
  EXPECT_EQ(old.quantity("psnr")->unit, "dB");
  EXPECT_EQ(old.quantity("psnr")->direction, Direction::HigherIsBetter);
  EXPECT_EQ(old.quantity("gpu_ms")->pass, "frame");
  EXPECT_EQ(old.quantity("psnr_like_figure")->direction, std::nullopt) << "unknown, not guessed";
  EXPECT_EQ(old.quantity("psnr_like_figure")->title, "Psnr like figure");
  EXPECT_EQ(old.quantity("tiles_px")->direction, Direction::LowerIsBetter) << "a counter is work done";
  EXPECT_TRUE(old.parameters.empty());
  EXPECT_EQ(rawSql(file, "PRAGMA user_version"), "2");
}

TEST_F(StoreTest, WritingToAStoreOfSchemaTwoAddsTheTablesAndLeavesTheRest) {
  const std::string file = writeSchemaTwo(path("old.sqlite"));
  {
    Store store(file, Access::ReadWrite);
    ASSERT_EQ(store.allRuns().size(), 1U);
    EXPECT_EQ(store.allRuns()[0].measurements.size(), 4U);
    EXPECT_EQ(store.descriptions(store.experiments().at(0).id).quantity("psnr")->title, "PSNR");
    const int64_t id = store.putExperiment(experimentOf("new"), {}, rimAndNodes());
    EXPECT_EQ(store.descriptions(id).quantities.size(), 3U);
  }
  EXPECT_EQ(rawSql(file, "PRAGMA user_version"), "3");
  EXPECT_EQ(rawSql(file, "PRAGMA integrity_check"), "ok");
}

TEST_F(StoreTest, AMergeJoinsWhatTwoShardsSay) {
  Store left(path("left.sqlite"), Access::ReadWrite), right(path("right.sqlite"), Access::ReadWrite);
  Descriptions half = rimAndNodes(), other = rimAndNodes();
  half.quantities.resize(1);
  half.parameters.resize(1);
  half.parameters[0].title = "As the left has it";
  const int64_t id = left.putExperiment(experimentOf("e"), {}, half);
  right.putExperiment(experimentOf("e"), {}, other);
  left.merge(right);
  EXPECT_EQ(left.descriptions(id).quantities, other.quantities);
  ASSERT_EQ(left.descriptions(id).parameters.size(), 2U);
  EXPECT_EQ(left.descriptions(id).parameters[0].title, "As the left has it");
}

TEST_F(StoreTest, AStoreOfSchemaTwoIsMerged) {
  const Store old(writeSchemaTwo(path("old.sqlite")), Access::ReadOnly);
  Store store(path("s.sqlite"), Access::ReadWrite);
  EXPECT_EQ(store.merge(old), 1);
  EXPECT_EQ(store.descriptions(store.experiments().at(0).id).quantity("psnr")->title, "PSNR");
}

}  // namespace
}  // namespace limen::store
