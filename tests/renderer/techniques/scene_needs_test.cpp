// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are built to need one thing each, and what the selector makes of them.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

class SceneNeedsTest : public TechniqueTest {
 protected:
  static constexpr glm::ivec2 kSizePx{64, 48};

  struct Chosen {
    std::vector<std::string> remarks;
    Rendered rendered;
  };

  static Chosen choose(const scene::Scene& scene, Given given = {}) {
    given.emplace("resolution", int64_t{256});
    given.emplace("probe_divisor", int64_t{1});
    const TechniqueInfo& info = TechniqueRegistry::instance().get("soft_shadows/scene_needs");
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, kSizePx);
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    Chosen out{made->remarks(), {made->product().read(), frame.get<frame::Receivers>().texture().read(), {}}};
    frame.end();
    out.rendered.counters = made->count(frame);
    return out;
  }
};

TEST_F(SceneNeedsTest, ALightSmallerThanATexelThrowsHardShadows) {
  const Chosen chosen = choose(makeScene("two_boxes", {{"light_size", 0.001}}));
  EXPECT_THAT(chosen.remarks.at(0), StartsWith("chosen: soft_shadows/hard"));
  EXPECT_THAT(chosen.remarks, Contains(StartsWith("hard shadows: the widest penumbra")));
  EXPECT_LE(chosen.rendered.counter("penumbra_texels"), 1.0);
}

TEST_F(SceneNeedsTest, WhatTheLightsCentreDoesNotSeeNeedsASecondLayer) {
  // A high box's sides, which the light sees from its rim alone.
  const Chosen chosen = choose(makeScene("box_under_light", {{"box_height", 2.0}, {"light_size", 1.5}}));
  EXPECT_THAT(chosen.remarks, Contains(StartsWith("two peeled layers")));
  EXPECT_THAT(chosen.remarks, Contains("bitmask: required by layers"));
  EXPECT_THAT(chosen.remarks.at(0), HasSubstr("maps=peeled"));
}

TEST_F(SceneNeedsTest, LayersAreNotBlended) {
  // Any change of level is one too many, and layers stay.
  const Chosen chosen = choose(makeScene("box_under_light", {{"box_height", 2.0}, {"light_size", 1.5}}),
                               {{"blend_share", 0.0}, {"budget", int64_t{25}}});
  EXPECT_THAT(chosen.remarks, Contains(StartsWith("two peeled layers")));
  EXPECT_THAT(chosen.remarks, Contains(HasSubstr("masks of several layers cannot be blended")));
}

TEST_F(SceneNeedsTest, OneFlatCasterNeedsNeitherLayersNorMasks) {
  // A single rectangle parallel to the map: no texel's projection overlaps another's. What is left between
  // areas and masks is the masks' rounding: an edge off by up to half a row of 16 on either axis, 1/64 of the
  // light on average.
  const Chosen chosen = choose(makeScene("parallel_rectangle"), {{"tolerance", 1.0 / 64.0}});
  EXPECT_THAT(chosen.remarks.at(0), StartsWith("chosen: soft_shadows/backprojection"));
  EXPECT_THAT(chosen.remarks, Contains(StartsWith("one map")));
  EXPECT_THAT(chosen.remarks, Contains(StartsWith("areas")));
}

TEST_F(SceneNeedsTest, AreasKnowNoRoundLights) {
  const Chosen chosen = choose(makeScene("parallel_rectangle", {{"light_shape", std::string("disc")}}));
  EXPECT_THAT(chosen.remarks, Contains("bitmask: the light is not a rectangle"));
  EXPECT_THAT(chosen.remarks.at(0), StartsWith("chosen: soft_shadows/bitmask"));
}

TEST_F(SceneNeedsTest, SlatsOfATexelAreNoMesh) {
  // 200 slats that cover a tenth of the map's width in all: thinner than its texels.
  const Chosen chosen = choose(makeScene("comb", {{"slats", int64_t{200}}, {"width", 0.1}}));
  EXPECT_THAT(chosen.remarks, Contains(StartsWith("micropatches")));
}

TEST_F(SceneNeedsTest, LeavesOutNoMoreThanItsToleranceAllows) {
  // Everything, layers left out, fewer samples, areas: each step changes the mean where there is shadow by
  // the tolerance at most, so three steps by three times that. Structures and blended levels are held at what
  // they are: no limit on the budget, so that there is one level, and all areas are narrowed alike.
  for (const char* name : {"comb", "box_under_light", "card_stack"}) {
    const scene::Scene scene = makeScene(name);
    const double tolerance = 0.01;
    const Chosen chosen =
        choose(scene, {{"tolerance", tolerance}, {"budget", int64_t{0}}, {"build_weight", 1e6}});
    const Rendered everything = render(scene, "soft_shadows/bitmask",
                                       {{"resolution", int64_t{256}},
                                        {"budget.limit", int64_t{0}},
                                        {"maps", std::string("peeled")},
                                        {"maps.layers", int64_t{2}}},
                                       kSizePx);
    const bool quads = chosen.remarks.at(0).find("occluders=microquads") != std::string::npos;
    double sum = 0.0, gained = 0.0, pixels = 0.0;
    for (size_t i = 0; i < everything.product.pixels(); ++i) {
      const double v = everything.product.data[i], w = chosen.rendered.product.data[i];
      ASSERT_TRUE(std::isfinite(w)) << name;
      // At least the pixels that were compared, or such as do not differ.
      if (v >= 1.0 && w >= 1.0) continue;
      pixels += 1.0;
      sum += std::abs(v - w);
      gained += std::max(w - v, 0.0);
    }
    ASSERT_GT(pixels, 20.0) << name;
    // Microquads may take light away by their smaller bias, but let no more through than a fourth step.
    if (quads)
      EXPECT_LE(gained / pixels, 4.0 * tolerance) << name;
    else
      EXPECT_LE(sum / pixels, 3.0 * tolerance) << name;
  }
}

TEST_F(SceneNeedsTest, NoShadowInViewIsNoReasonToFail) {
  scene::Scene scene = makeScene("two_boxes");
  scene::Camera camera;
  camera.eye = {0.0, 50.0, 0.0};
  camera.target = {0.0, 100.0, 0.001};
  scene.camera.keys = {{0.0, camera}};
  const Chosen chosen = choose(scene);
  for (const float v : chosen.rendered.product.data) ASSERT_EQ(v, 1.0F);
  EXPECT_THAT(chosen.remarks, Contains(testing::AnyOf(StartsWith("hard shadows"), StartsWith("one map"))));
}

}  // namespace
}  // namespace limen::techniques
