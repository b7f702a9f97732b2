// SPDX-License-Identifier: BSD-3-Clause
// Frames of a path against frames rendered on their own: in a scene whose light has been moved by hand, and
// in one whose camera starts later on its path.
#include <gtest/gtest.h>

#include "experiments/base/error.h"
#include "experiments/frame_path.h"
#include "experiments/scene_rendering.h"
#include "renderer/techniques/technique.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::experiments {
namespace {

constexpr glm::ivec2 kSizePx(48, 36);
constexpr int kSteps = 3;

class FramePathTest : public testing::Test {
 protected:
  static gl::Context& context() {
    static const std::unique_ptr<gl::Context> shared = gl::createHeadlessContext();
    return *shared;
  }
  void SetUp() override { context(); }
  void TearDown() override { EXPECT_NO_THROW(context().checkDebugMessages()); }

  static Configuration technique(const std::string& name,
                                 const std::map<std::string, ParameterValue>& given) {
    const techniques::TechniqueInfo& info = techniques::TechniqueRegistry::instance().get(name);
    return {name, info.version, ParameterValues(info.parameters, given)};
  }
  static scene::Scene sceneOf(const std::string& name,
                              const std::map<std::string, ParameterValue>& given = {}) {
    return scene::buildScene(
        name, ParameterValues(scene::SceneRegistry::instance().get(name).allParameters(), given));
  }
  static Image alone(scene::Scene scene, const Configuration& of) {
    const frame::SceneOnGpu onGpu(std::move(scene));
    return renderOnce(context(), onGpu, kSizePx, of);
  }

  struct Step {
    Image test, reference, testBefore;
    double largestDisplacementPx = 0.0;
  };
  std::vector<Step> render(const scene::Scene& scene, const PlannedRun& run,
                           const perception::PathRequest& request) {
    const frame::SceneOnGpu onGpu(scene);
    ReferenceCache references(folder_.path("references"));
    std::vector<Step> out;
    FramePath path(context(), onGpu, kSizePx, run, references, "run " + run.reference.name);
    path.render(request,
                [&](int step, const perception::PathFrame& before, const perception::PathFrame& now) {
                  EXPECT_EQ(step, static_cast<int>(out.size()) + 1);
                  out.push_back({now.test->read(), now.reference->read(), before.test->read(), 0.0});
                  if (!now.displacement) return;
                  for (const float value : now.displacement->read().data)
                    out.back().largestDisplacementPx =
                        std::max(out.back().largestDisplacementPx, std::abs(double{value}));
                });
    remarks_ = path.remarks();
    return out;
  }
  std::vector<std::string> remarks_;  ///< of the path last rendered

  analysis::TemporaryFolder folder_;
};

// What goes wrong in frames of a path alone is told, and nothing that is known as soon as the technique is
// prepared.
TEST_F(FramePathTest, RemarksOnItsFramesAreKept) {
  PlannedRun run;
  run.reference = technique("visibility_fields/traced_occlusion", {{"rays", int64_t{4}}});
  for (const double capacity : {0.0001, 1.0}) {
    run.technique =
        technique("visibility_fields/ambient_occlusion", {{"rays", int64_t{4}},
                                                          {"positions", int64_t{82}},
                                                          {"storage.detail", std::string("by_size")},
                                                          {"storage.detail.error", 0.0001},
                                                          {"combine.near", std::string("doubtful")},
                                                          {"combine.near.capacity", capacity}});
    render(sceneOf("moving/wheel"), run, {perception::CameraPath{0.5}, kSteps});
    ASSERT_EQ(remarks_.size(), capacity < 1.0 ? 1U : 0U);
    if (capacity < 1.0) {
      EXPECT_NE(remarks_[0].find("doubt"), std::string::npos) << remarks_[0];
    }
  }
}

TEST_F(FramePathTest, MovesTheLightInItsPlane) {
  PlannedRun run;
  run.technique = technique("soft_shadows/backprojection", {{"resolution", int64_t{128}}});
  run.reference = technique("soft_shadows/exact_union", {});
  const scene::Scene still = sceneOf("two_boxes");
  const std::vector<Step> steps = render(still, run, {perception::LightPath{0.25, 90.0}, kSteps});
  ASSERT_EQ(steps.size(), size_t{kSteps});
  Image before = alone(still, run.technique);
  for (int step = 1; step <= kSteps; ++step) {
    scene::Scene moved = still;
    moved.lights[0].centre += 0.25 * step * moved.lights[0].size.y * moved.lights[0].axisY;  // 90 degrees
    const Step& found = steps[static_cast<size_t>(step - 1)];
    EXPECT_EQ(found.testBefore.data, before.data) << step;
    before = alone(moved, run.technique);
    EXPECT_EQ(found.test.data, before.data) << step;
    EXPECT_NE(found.test.data, found.testBefore.data) << "nothing moved";
    EXPECT_EQ(found.reference.data, alone(moved, run.reference).data) << step;
  }
}

TEST_F(FramePathTest, FollowsTheCamerasPath) {
  PlannedRun run;
  run.technique = technique("lod/discrete", {});
  run.reference = technique("lod/finest", {{"samples", int64_t{1}}});
  const std::vector<Step> steps = render(sceneOf("lod/object"), run, {perception::CameraPath{0.5}, kSteps});
  ASSERT_EQ(steps.size(), size_t{kSteps});
  for (int step = 1; step <= kSteps; ++step) {
    const scene::Scene later = sceneOf("lod/object", {{"camera", "built_in"}, {"camera.time_s", 0.5 * step}});
    const Step& found = steps[static_cast<size_t>(step - 1)];
    EXPECT_EQ(found.test.data, alone(later, run.technique).data) << step;
    EXPECT_EQ(found.reference.data, alone(later, run.reference).data) << step;
    EXPECT_GT(found.largestDisplacementPx, 0.1) << step;
  }
}

// Cuts that are right do not depend on where they start; lazy ones lag behind a light that moves, and would
// not if every frame were rendered on its own.
TEST_F(FramePathTest, OneTechniqueFollowsTheLight) {
  const scene::Scene still = sceneOf("cornell_box");
  std::map<std::string, ParameterValue> given = {
      {"lights", int64_t{16}}, {"levels", int64_t{12}}, {"epsilon", 1.0}, {"room", int64_t{8192}}};
  int different = 0;
  for (const char* cuts : {"incremental", "lazy"}) {
    given["cuts"] = std::string(cuts);
    PlannedRun run;
    run.technique = technique("many_lods/instant_radiosity", given);
    run.reference = technique("many_lods/traced_radiosity", {{"lights", int64_t{16}}});
    const std::vector<Step> steps = render(still, run, {perception::LightPath{0.3, 0.0}, kSteps});
    ASSERT_EQ(steps.size(), size_t{kSteps});
    for (int step = 1; step <= kSteps; ++step) {
      scene::Scene moved = still;
      moved.lights[0].centre += 0.3 * step * moved.lights[0].size.x * moved.lights[0].axisX;
      const Image expected = alone(moved, run.technique);
      if (std::string(cuts) == "incremental") {
        EXPECT_EQ(steps[size_t(step) - 1].test.data, expected.data) << step;
      } else {
        different += steps[size_t(step) - 1].test.data != expected.data ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(different, kSteps);
}

TEST_F(FramePathTest, RefusesACameraWithoutAPath) {
  PlannedRun run;
  run.technique = technique("soft_shadows/hard", {});
  run.reference = technique("soft_shadows/exact_union", {});
  EXPECT_THROW(render(sceneOf("two_boxes"), run, {perception::CameraPath{}, kSteps}), Error);
}

}  // namespace
}  // namespace limen::experiments
