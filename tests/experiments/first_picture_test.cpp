// SPDX-License-Identifier: BSD-3-Clause
// A sweep that asks for the first picture's time, and what its store then says. Of times nothing is demanded
// but that parts are no longer than the whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/gl_executor.h"
#include "experiments/runner.h"
#include "renderer/catalogue.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::experiments {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

class NoObserver : public SweepObserver {
 public:
  void begin(size_t, size_t) override {}
  void measuring(const PlannedRun&, size_t) override {}
  void finished(const PlannedRun&, const store::Run&) override {}
  void doneElsewhere(const PlannedRun&) override {}
  void waiting(size_t) override {}
};

const char* const kMirrors =
    "scenes: [{name: mirrors/planes, planes: 2}]\n"
    "techniques: [{name: reflections/scene_needs}, {name: reflections/ray_traced}]\n"
    "reference: {name: reflections/reference}\n"
    "metrics: [{name: rmse, region: reflectors}]\n";

std::string descriptorText(const std::string& what, const std::string& timing) {
  return "title: a\nquestion: b\n" + what + "image: {width: 32, height: 24}\ntiming: " + timing +
         "\nartefacts: {pictures: false}\n";
}

class FirstPictureTest : public testing::Test {
 protected:
  std::vector<store::Run> sweep(const std::string& timing, const std::string& what = kMirrors) {
    const std::shared_ptr<const Catalogue> catalogue = catalogueFromRegistries();
    const Descriptor descriptor = parseDescriptor(descriptorText(what, timing), "d.yaml", *catalogue, {});
    const Plan plan = makePlan(descriptor, *catalogue);
    store::Store results(folder_.path("r.sqlite"), store::Access::ReadWrite);
    const auto executor = makeGlExecutor(folder_.path("results"), folder_.path("results/references"));
    NoObserver observer;
    runSweep(plan, results, *executor, nlohmann::json::object(), {}, observer);
    std::vector<store::Run> out;
    for (store::Run& run : results.allRuns())
      for (const PlannedRun& planned : plan.runs)
        if (run.key == planned.key) out.push_back(std::move(run));
    EXPECT_EQ(out.size(), plan.runs.size());
    return out;
  }
  static const store::Measurement* find(const store::Run& run, const std::string& name) {
    for (const store::Measurement& one : run.measurements)
      if (one.name == name) return &one;
    return nullptr;
  }

  analysis::TemporaryFolder folder_;
};

TEST_F(FirstPictureTest, IsMeasuredOnRequestAlone) {
  for (const store::Run& run : sweep("{warmup: 0, frames: 1, rounds: 1}")) {
    EXPECT_EQ(run.status, "done") << run.error;
    EXPECT_EQ(find(run, "first_picture_ms"), nullptr);
  }
  for (const store::Run& run : sweep("{warmup: 0, frames: 1, rounds: 1, first_picture: true}")) {
    ASSERT_EQ(run.status, "done") << run.error;
    const store::Measurement *all = find(run, "first_picture_ms"),
                             *compile = find(run, "first_picture_compile_ms"),
                             *upload = find(run, "first_picture_upload_ms");
    ASSERT_TRUE(all && compile && upload) << run.technique;
    EXPECT_EQ(all->unit, "ms");
    EXPECT_EQ(all->kind, "time");
    // A context of its own has no program yet.
    EXPECT_GT(*compile->value, 0.0);
    EXPECT_GT(*upload->value, 0.0);
    EXPECT_LT(*compile->value + *upload->value, *all->value);
    // The run itself went on in its own context.
    const store::Measurement* error = find(run, "rmse");
    ASSERT_NE(error, nullptr);
    EXPECT_LT(*error->value, 0.05);
  }
}

TEST_F(FirstPictureTest, SequencesBehindCountersAreInTheStore) {
  const std::vector<store::Run> runs =
      sweep("{warmup: 0, frames: 1, rounds: 1}",
            "scenes: [{name: global_illumination/room}]\n"
            "techniques: [{name: global_illumination/voxel_propagation, resolution: 8, iterations: [3, 5]}]\n"
            "metrics: [non_finite]\n");
  ASSERT_EQ(runs.size(), 2U);
  std::vector<size_t> lengths;
  for (const store::Run& run : runs) {
    const nlohmann::json& flux = run.sceneFacts.at("series").at("flux_after_step");
    EXPECT_THAT(flux.at("summary").get<std::string>(), HasSubstr("Flux"));
    const auto values = flux.at("values").get<std::vector<double>>();
    lengths.push_back(values.size());
    ASSERT_NE(find(run, "injected_flux"), nullptr);
    EXPECT_EQ(values.at(0), find(run, "injected_flux")->value);
  }
  EXPECT_THAT(lengths, testing::UnorderedElementsAre(4, 6));
}

TEST_F(FirstPictureTest, WhatATechniqueChoseIsInTheStoreWithItsReasons) {
  for (const store::Run& run : sweep("{warmup: 0, frames: 1, rounds: 1}")) {
    if (run.technique != "reflections/scene_needs") continue;
    const auto remarks = run.sceneFacts.at("remarks").get<std::vector<std::string>>();
    EXPECT_THAT(remarks, Contains("chosen: reflections/planar_mirror, planes=2"));
    EXPECT_THAT(remarks, Contains("by rule: all mirrors need it"));
    EXPECT_THAT(remarks, Contains(AllOf(StartsWith("mirror 'mirror'"), HasSubstr("a plane"))).Times(2));
    EXPECT_THAT(remarks, Contains(StartsWith("at full size: ")));
    const store::Measurement* met = find(run, "target_met");
    ASSERT_NE(met, nullptr);
    EXPECT_EQ(met->kind, "counter");
  }
}

}  // namespace
}  // namespace limen::experiments
