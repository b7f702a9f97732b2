// SPDX-License-Identifier: BSD-3-Clause
// The interactive perceptual pipeline on scenes whose counts can be worked out by hand.
#include <epoxy/gl.h>

#include "tests/renderer/techniques/perceptual_lod_fixture.h"

namespace limen::techniques {
namespace {

using Levels = std::vector<int>;

/// Squares of sides 1, 1.25 and 1.5 are 16, 20 and 24 pixels wide: they cover 256, 400 and 576 pixels, and
/// differ from the finest in 144 and 320. Albedos of 0.8 before 0.2 are 150 cd/m2 apart, far above any
/// threshold.
scene::LodSet growingSquares() {
  scene::LodSet set{"square", {}};
  for (const double side : {1.0, 1.25, 1.5})
    set.levels.push_back({scene::card(glm::dvec3(0.0), {0.5 * side, 0.0, 0.0}, {0.0, 0.5 * side, 0.0})});
  return set;
}

class Counting : public PerceptualLodTest, public testing::WithParamInterface<const char*> {
 protected:
  Given counting(Given given = {}) const {
    given["tests.count"] = std::string(GetParam());
    return unlit(std::move(given));
  }
};

TEST_P(Counting, FindsEveryPixelThatALevelAddsOrLacks) {
  scene::Scene scene = wall(0.2F);
  addSquares(scene, growingSquares(), glm::dvec3(0.0), 0.8F);
  // Turned round, coarser levels shrink: what the finest shows is missing.
  scene::Scene shrinking = wall(0.2F);
  addSquares(shrinking, squares({1.5, 1.25, 1.0}), glm::dvec3(0.0), 0.8F);
  for (const bool grows : {true, false}) {
    Bench bench(grows ? scene : shrinking,
                settings(counting({{"start_level", std::string("coarsest")},
                                   {"rule.coarsen", std::string("if_invisible")}})));
    bench.run(2);
    ASSERT_EQ(bench.pipeline.taken().size(), 1U);
    const LevelTest first = bench.pipeline.taken()[0];
    EXPECT_EQ(first.level, 2);
    EXPECT_EQ(first.coveredPx, 576U);  // at either level
    EXPECT_EQ(first.visiblePx, 320U);
    // The test before set it one level finer: the next one tests level 1.
    bench.run(1);
    ASSERT_EQ(bench.pipeline.taken().size(), 1U);
    const LevelTest second = bench.pipeline.taken()[0];
    EXPECT_EQ(second.level, 1);
    EXPECT_EQ(second.coveredPx, grows ? 400U : 576U);
    EXPECT_EQ(second.visiblePx, grows ? 144U : 576U - 400U);
    EXPECT_EQ(second.nextVisiblePx, 320U);
    // The picture of visible pixels shows as many as were counted in the frame whose test came last: level 0.
    const Image visible = bench.pipeline.debugViews().at("visible_pixels")->read();
    EXPECT_EQ(std::count(visible.data.begin(), visible.data.end(), 1.0F), 0);
  }
}

TEST_P(Counting, HidesWhatOthersHide) {
  // The right half of the square lies behind a part of the background, the object beside it covers nothing.
  scene::Scene scene = wall(0.2F);
  addPart(scene, "screen", scene::card({1.0, 0.0, 0.5}, {1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}), glm::vec3(0.4F));
  addSquares(scene, growingSquares(), glm::dvec3(0.0), 0.8F);
  Bench bench(scene, settings(counting({{"start_level", std::string("coarsest")}})));
  bench.run(2);
  EXPECT_EQ(bench.pipeline.taken().at(0).coveredPx, 576U / 2);
  EXPECT_EQ(bench.pipeline.taken().at(0).visiblePx, 320U / 2);
}

INSTANTIATE_TEST_SUITE_P(Forms, Counting, testing::Values("compute", "query"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_F(PerceptualLodTest, QueriesCountWhatTheComputeShaderCounts) {
  const scene::Scene scene =
      makeScene("lod/field", {{"grid.rows", int64_t{3}}, {"grid.columns", int64_t{3}}});
  std::vector<std::vector<LevelTest>> found;
  for (const char* form : {"compute", "query"}) {
    Bench bench(scene,
                settings({{"tests.count", std::string(form)},
                          {"rule.coarsen", std::string("if_invisible")},
                          {"start_level", std::string("coarsest")},
                          {"tests.objects_per_frame", int64_t{3}}}),
                {96, 72});
    std::vector<LevelTest> all;
    for (int i = 0; i < 10; ++i) {
      bench.run(1);
      all.insert(all.end(), bench.pipeline.taken().begin(), bench.pipeline.taken().end());
    }
    found.push_back(all);
  }
  ASSERT_EQ(found[0].size(), 27U);
  ASSERT_EQ(found[1].size(), found[0].size());
  uint32_t visible = 0;
  for (size_t i = 0; i < found[0].size(); ++i) {
    EXPECT_EQ(found[0][i].object, found[1][i].object);
    EXPECT_EQ(found[0][i].coveredPx, found[1][i].coveredPx);
    EXPECT_EQ(found[0][i].visiblePx, found[1][i].visiblePx);
    EXPECT_EQ(found[0][i].nextVisiblePx, found[1][i].nextVisiblePx);
    visible += found[0][i].visiblePx;
  }
  EXPECT_GT(visible, 0U);
}

TEST_F(PerceptualLodTest, WhatCannotBeSeenGoesToItsCoarsestLevel) {
  scene::Scene scene = wall(0.2F);
  addSquares(scene, growingSquares(), glm::dvec3(0.0), 0.2F);
  Bench bench(scene, settings(unlit()));
  bench.run(4);
  EXPECT_EQ(bench.pipeline.shown().levels, Levels{2});
  EXPECT_EQ(bench.pipeline.control().switches(), 2);
  EXPECT_EQ(bench.pipeline.control().reversals(), 0);
}

TEST_F(PerceptualLodTest, WhatWouldBeSeenStaysFinestIfTheNextLevelIsLookedAt) {
  scene::Scene scene = wall(0.2F);
  addSquares(scene, growingSquares(), glm::dvec3(0.0), 0.8F);
  Bench bench(scene, settings(unlit({{"rule.coarsen", std::string("if_invisible")}})));
  bench.run(8);
  EXPECT_EQ(bench.pipeline.shown().levels, Levels{0});
  EXPECT_EQ(bench.pipeline.control().switches(), 0);
}

TEST_F(PerceptualLodTest, OnlyWhatMayChangeALevelIsDrawn) {
  scene::Scene scene = wall(0.2F);
  addSquares(scene, growingSquares(), glm::dvec3(0.0), 0.8F);
  // 144 of 400 pixels differ at level 1, 320 at level 2.
  const auto run = [&](const char* coarsen, double lower, double upper, const char* start) {
    Bench bench(scene, settings(unlit({{"rule.coarsen", std::string(coarsen)},
                                       {"rule.limits.lower", lower},
                                       {"rule.limits.upper", upper},
                                       {"start_level", std::string(start)}})));
    std::vector<std::string> drawn;
    for (int i = 0; i < 5; ++i) {
      bench.run(1);
      const ObjectTest& test = bench.pipeline.planned().at(0);
      drawn.push_back(std::to_string(test.level) + (test.finest ? "f" : "") + (test.next ? "n" : ""));
    }
    return drawn;
  };
  using Drawn = std::vector<std::string>;
  // At the finest level only the next one is of interest, and not even that by the thesis's rule.
  EXPECT_EQ(run("if_invisible", 4.0, 16.0, "finest"), (Drawn{"0n", "0n", "0n", "0n", "0n"}));
  EXPECT_EQ(run("at_once", 0.0, 16.0, "finest"), (Drawn{"0", "0", "0", "0", "0"}));
  // Level 1 is kept with 144 pixels, which is known from the first test on: the next level is tried once.
  EXPECT_EQ(run("if_invisible", 4.0, 150.0, "finest"), (Drawn{"0n", "1fn", "1f", "1f", "1f"}));
  // The coarsest has no next.
  EXPECT_EQ(run("if_invisible", 4.0, 400.0, "coarsest"), (Drawn{"2f", "2f", "2f", "2f", "2f"}));
}

TEST_F(PerceptualLodTest, ALevelWhoseNextWasNotTriedIsKept) {
  TestedLevels levels(LevelRule{PixelLimits{4.0, 16.0}, Coarsen::IfInvisible}, {3}, 1);
  EXPECT_TRUE(levels.triesNext(0));
  levels.apply({0, 1, 100, 9, 50, true});  // between the limits
  EXPECT_FALSE(levels.triesNext(0));
  levels.apply({0, 1, 100, 2, 0, false});  // might go coarser, but what is there was not tried
  EXPECT_EQ(levels.levels()[0], 1);
  EXPECT_TRUE(levels.triesNext(0));
  levels.apply({0, 1, 100, 2, 0, true});
  EXPECT_EQ(levels.levels()[0], 2);
  EXPECT_FALSE(levels.triesNext(0));  // the coarsest
  levels.apply({0, 2, 100, 30, 0, false});
  EXPECT_EQ(levels.levels()[0], 1);
  EXPECT_TRUE(levels.triesNext(0));
}

TEST_F(PerceptualLodTest, OneThresholdOscillatesAndABandDoesNot) {
  scene::Scene scene = wall(0.2F);
  addSquares(scene, growingSquares(), glm::dvec3(0.0), 0.8F);
  constexpr int kFrames = 9;
  // 0 pixels at level 0 are below, 144 at level 1 above: the level changes with every result, which is every
  // frame but the first.
  Bench one(scene, settings(unlit({{"rule.limits.lower", 100.0}, {"rule.limits.upper", 100.0}})));
  one.run(kFrames);
  EXPECT_EQ(one.pipeline.control().switches(), kFrames - 1);
  EXPECT_EQ(one.pipeline.control().reversals(), kFrames - 2);
  // 144 lies in the band: level 1 is kept.
  Bench band(scene, settings(unlit({{"rule.limits.lower", 100.0}, {"rule.limits.upper", 150.0}})));
  band.run(kFrames);
  EXPECT_EQ(band.pipeline.control().switches(), 1);
  EXPECT_EQ(band.pipeline.control().reversals(), 0);
  EXPECT_EQ(band.pipeline.shown().levels, Levels{1});
  // As a share of the 400 pixels covered: 0.36.
  Bench share(scene, settings(unlit({{"rule.limits.lower", 0.3},
                                     {"rule.limits.upper", 0.4},
                                     {"rule.limits", std::string("share")}})));
  share.run(kFrames);
  EXPECT_EQ(share.pipeline.shown().levels, Levels{1});
  Bench less(scene, settings(unlit({{"rule.limits.lower", 0.3},
                                    {"rule.limits.upper", 0.35},
                                    {"rule.limits", std::string("share")}})));
  less.run(kFrames);
  EXPECT_EQ(less.pipeline.control().switches(), kFrames - 1);
}

TEST_F(PerceptualLodTest, AMaskingPatternRaisesTheLevelThatIsTolerated) {
  // On a flat field of 100 cd/m2 the threshold is 0.2 tvi(100) = 1.11181 (elevation 1): a step of 1.0 passes,
  // one of 1.25 does not. Bars before the object, 2 of 8 pixels and 5 cpd on this display, mask more. They
  // are 5.3 cd/m2 brighter: a contrast of at most 0.053, 28 times what is just visible where vision is best
  // (peak sensitivity 525), raises thresholds by at most 28^0.7 = 10 there, and by less than 20 at any
  // frequency (F = 6.7 at 20 cpd, where the contrast is 4 times just visible). So a step of 30 stays visible.
  const auto tolerated = [&](bool bars) {
    scene::Scene scene = wall(static_cast<float>(kAlbedo100));
    light(scene);
    if (bars) {
      scene::Mesh mesh;
      for (int i = -8; i < 8; ++i)
        scene::append(mesh, scene::card({0.25 * i + 0.03, 0.0, 1.0}, {0.04, 0.0, 0.0}, {0.0, 2.0, 0.0}));
      addPart(scene, "bars", mesh, glm::vec3(0.42F));
    }
    addSquares(scene, shades({0.0, 0.5, 1.0, 1.25, 1.6, 30.0}), glm::dvec3(0.0),
               static_cast<float>(kAlbedo100));
    Bench bench(scene,
                settings({{"rule.coarsen", std::string("if_invisible")},
                          {"rule.limits.lower", 1.0},
                          {"rule.limits.upper", 1.0}}),
                {128, 128});
    bench.run(10);
    return bench.pipeline.shown().levels.at(0);
  };
  EXPECT_EQ(tolerated(false), 2);
  EXPECT_GE(tolerated(true), 3);
  EXPECT_LT(tolerated(true), 5);
}

TEST_F(PerceptualLodTest, ResultsComeAsLateAsToldAndThoseOfALeftLevelAreDropped) {
  scene::Scene scene = wall(0.2F);
  addSquares(scene, growingSquares(), glm::dvec3(0.0), 0.2F);
  Bench bench(scene, settings(unlit({{"tests.latency_frames", int64_t{3}}})));
  bench.run(3);
  EXPECT_EQ(bench.pipeline.shown().levels, Levels{0});
  EXPECT_TRUE(bench.pipeline.taken().empty());
  // Frame 3 takes the test of frame 0 and goes to level 1; those of frames 1 and 2 were of level 0 as well.
  bench.run(3);
  EXPECT_EQ(bench.pipeline.shown().levels, Levels{1});
  EXPECT_EQ(bench.pipeline.control().dropped(), 2);
  bench.run(1);
  EXPECT_EQ(bench.pipeline.shown().levels, Levels{2});
}

TEST_F(PerceptualLodTest, WithoutWaitingResultsAreUsedOnceTheyAreThere) {
  for (const char* form : {"compute", "query"}) {
    scene::Scene scene = wall(0.2F);
    addSquares(scene, growingSquares(), glm::dvec3(0.0), 0.2F);
    Bench bench(scene, settings(unlit({{"tests.count", std::string(form)}})));
    // However late the results are: no frame tests more than the batches under way allow, none is lost.
    for (int i = 0; i < 40; ++i) bench.pipeline.render(0.0, false);
    glFinish();
    for (int i = 0; i < 3; ++i) {
      bench.pipeline.render(0.0, false);
      glFinish();
    }
    EXPECT_EQ(bench.pipeline.shown().levels, Levels{2});
    EXPECT_EQ(bench.pipeline.control().switches(), 2);
  }
}

TEST_F(PerceptualLodTest, FramesInFlightKeepTheirOwnObjects) {
  // All objects stay finest (nothing is below delta_l = 0), so no test may find a difference, although
  // several frames with other objects under test are under way at a time.
  const scene::Scene scene =
      makeScene("lod/field", {{"grid.rows", int64_t{4}}, {"grid.columns", int64_t{3}}});
  Bench bench(scene, settings({{"rule.limits.lower", 0.0}, {"tests.latency_frames", int64_t{6}}}),
              {320, 240});
  int tests = 0;
  for (int i = 0; i < 16; ++i) {
    bench.run(1);
    for (const LevelTest& test : bench.pipeline.taken()) {
      EXPECT_EQ(test.visiblePx, 0U) << "object " << test.object;
      ++tests;
    }
  }
  EXPECT_GT(tests, 10);
}

TEST_F(PerceptualLodTest, UnseenObjectsKeepTheirLevel) {
  scene::Scene scene = wall(0.2F);
  addSquares(scene, growingSquares(), {0.0, 0.0, -3.0}, 0.8F);  // behind the wall
  addSquares(scene, growingSquares(), {50.0, 0.0, 0.0}, 0.8F);  // beside the picture
  addSquares(scene, growingSquares(), {0.0, 0.0, 50.0}, 0.8F);  // behind the camera
  Bench bench(scene, settings(unlit({{"tests.objects_per_frame", int64_t{3}}})));
  bench.run(5);
  EXPECT_EQ(bench.pipeline.shown().levels, (Levels{0, 0, 0}));
  EXPECT_EQ(bench.pipeline.control().tested(), 4);  // the first alone, in each frame but the last
}

TEST_F(PerceptualLodTest, ObjectsTakeTurns) {
  scene::Scene scene = wall(0.2F);
  for (int i = 0; i < 5; ++i) addSquares(scene, squares({0.3, 0.3}), {0.6 * (i - 2), 0.0, 0.0}, 0.8F);
  Bench bench(scene, settings(unlit({{"tests.objects_per_frame", int64_t{2}}})));
  std::vector<int> order;
  for (int i = 0; i < 6; ++i) {
    bench.run(1);
    for (const LevelTest& test : bench.pipeline.taken()) order.push_back(test.object);
  }
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4, 0, 1, 2, 3, 4}));
}

TEST_F(PerceptualLodTest, OddScenesAndPicturesStayFinite) {
  scene::Scene empty = wall(0.5F), black = wall(0.0F), nothing;
  addSquares(black, growingSquares(), glm::dvec3(0.0), 0.0F);
  setStillCamera(nothing, scene::Camera{});
  addSquares(nothing, growingSquares(), glm::dvec3(0.0), 0.5F);
  for (const scene::Scene* scene : {&empty, &black, &nothing})
    for (const glm::ivec2 size : {glm::ivec2(1), glm::ivec2(1, 9), glm::ivec2(33, 17)}) {
      Bench bench(*scene, settings({{"shading.background", 0.0}}), size);
      bench.run(4);
      for (const auto& [name, view] : bench.pipeline.debugViews())
        for (const float value : view->read().data) ASSERT_TRUE(std::isfinite(value)) << name;
      for (const float value : bench.pipeline.picture().read().data) ASSERT_TRUE(std::isfinite(value));
    }
}

TEST_F(PerceptualLodTest, TheSameFramesGiveTheSameBytes) {
  const scene::Scene scene = makeScene(
      "lod/field", {{"grid.rows", int64_t{3}}, {"grid.columns", int64_t{2}}, {"motion.speed", 4.0}});
  std::vector<std::vector<float>> ends;
  for (int run = 0; run < 2; ++run) {
    Bench bench(scene, settings({{"shading.shadow", true}}), {64, 48});
    for (int i = 0; i < 12; ++i) bench.run(1, 0.1 * i);
    ends.push_back(bench.pipeline.picture().read().data);
    EXPECT_GT(bench.pipeline.control().switches(), 0);
  }
  EXPECT_EQ(ends[0], ends[1]);
}

}  // namespace
}  // namespace limen::techniques
