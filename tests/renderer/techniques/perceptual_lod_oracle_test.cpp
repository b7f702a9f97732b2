// SPDX-License-Identifier: BSD-3-Clause
// The exhaustive search, and the pipeline and its baseline against it.
#include "renderer/techniques/perceptual_lod/distance_matched.h"
#include "tests/renderer/techniques/perceptual_lod_fixture.h"

namespace limen::techniques {
namespace {

class PerceptualLodOracle : public PerceptualLodTest {
 protected:
  static std::vector<OracleVerdict> search(const scene::Scene& scene, const PerceptualLodSettings& chosen,
                                           glm::ivec2 sizePx) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    return searchLevels(frame, 0.0, chosen.shading, chosen.model.seenOn());
  }
  static LevelRule upTo(double upperPx) { return {PixelLimits{0.0, upperPx}}; }
};

TEST_F(PerceptualLodOracle, FindsTheCoarsestLevelThatIsNotVisible) {
  scene::Scene scene = wall(0.2F);
  addSquares(scene, squares({1.0, 1.25, 1.5}), glm::dvec3(0.0), 0.8F);  // as in perceptual_lod_test.cpp
  addSquares(scene, squares({1.0, 1.5}), {40.0, 0.0, 0.0}, 0.8F);
  const std::vector<OracleVerdict> found = search(scene, settings(unlit()), {64, 64});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].coveredPx, (std::vector<uint32_t>{256, 400, 576}));
  EXPECT_EQ(found[0].visiblePx, (std::vector<uint32_t>{0, 144, 320}));
  EXPECT_EQ(found[0].coarsestInvisible(upTo(143)), 0);
  EXPECT_EQ(found[0].coarsestInvisible(upTo(144)), 1);
  EXPECT_EQ(found[0].coarsestInvisible(upTo(320)), 2);
  // 144 / 400 = 0.36, 320 / 576 = 0.56.
  EXPECT_EQ(found[0].coarsestInvisible(LevelRule{ShareLimits{0.0, 0.4}}), 1);
  EXPECT_FALSE(found[1].seen());

  // Chosen level 2 for oracle's 1: visible, one level too coarse; the unseen object does not count.
  const OracleComparison compared = compareWithOracle(found, upTo(144), {2, 1});
  EXPECT_EQ(compared.objectsSeen, 1);
  EXPECT_EQ(compared.wrongInvisibleShare, 1.0);
  EXPECT_EQ(compared.levelsAbove, 1.0);
  EXPECT_EQ(compared.levelsBelow, 0.0);
  EXPECT_EQ(compareWithOracle(found, upTo(144), {0, 0}).levelsBelow, 1.0);
  EXPECT_EQ(compareWithOracle({}, upTo(144), {}).wrongInvisibleShare, 0.0);
}

TEST_F(PerceptualLodOracle, AgreesWithThePipelineWhereLeavingTheObjectOutChangesLittle) {
  // Shades of 100 cd/m2 before a wall of 100 cd/m2: with or without the object the field is flat and the
  // threshold 1.11181, so both must draw the line between 1.0 and 1.25 (see perceptual_lod_test.cpp).
  scene::Scene scene = wall(static_cast<float>(kAlbedo100));
  light(scene);
  for (const double x : {-1.0, 1.0})
    addSquares(scene, shades({0.0, 0.5, 1.0, 1.25, 30.0}), {x, 0.3 * x, 0.0}, static_cast<float>(kAlbedo100));
  const PerceptualLodSettings chosen = settings({{"rule.coarsen", std::string("if_invisible")},
                                                 {"rule.limits.lower", 1.0},
                                                 {"rule.limits.upper", 1.0}});
  const std::vector<OracleVerdict> found = search(scene, chosen, {64, 64});
  EXPECT_EQ(found.at(0).coarsestInvisible(chosen.rule), 2);
  EXPECT_EQ(found.at(1).coarsestInvisible(chosen.rule), 2);
  Bench bench(scene, chosen);
  bench.run(8);
  EXPECT_EQ(bench.pipeline.shown().levels, (std::vector<int>{2, 2}));
}

TEST_F(PerceptualLodOracle, TechniqueShowsWhatItFound) {
  scene::Scene scene = wall(0.2F);
  addSquares(scene, squares({1.0, 1.25, 1.5}), glm::dvec3(0.0), 0.8F);
  const Rendered shown =
      render(scene, "lod/oracle", {{"limit.most", 150.0}, {"shading.ambient", 1.0}, {"shading.diffuse", 0.0}},
             {64, 64}, true);
  int bright = 0;
  for (size_t i = 0; i < shown.product.pixels(); ++i) bright += shown.product.data[4 * i] > 0.5F;
  EXPECT_EQ(bright, 400);  // level 1
  EXPECT_EQ(shown.counter("mean_level"), 1.0);
  EXPECT_EQ(shown.counter("levels_above_oracle"), 0.0);
  EXPECT_EQ(shown.counter("wrong_invisible_share"), 0.0);
}

TEST_F(PerceptualLodOracle, BaselineTakesTheSmallestFactorWithEnoughTriangles) {
  const scene::Scene scene =
      makeScene("lod/field", {{"grid.rows", int64_t{3}}, {"grid.columns", int64_t{2}}});
  const scene::LodView view{scene.camera.at(0.0), 72};
  const auto drawn = [&](double factor) {
    return scene::triangleCount(scene, scene::levelsByDistance(scene, view, factor));
  };
  const uint64_t least = drawn(0.0), most = drawn(1e9);
  ASSERT_LT(least, most);
  for (uint64_t wanted = least; wanted <= most; wanted += (most - least) / 23) {
    const double factor = factorForTriangles(scene, view, wanted);
    EXPECT_GE(drawn(factor), wanted);
    // By brute force: no factor of a fine grid below it is enough.
    for (double smaller = 0.01; smaller < factor * 0.999; smaller += 0.01) EXPECT_LT(drawn(smaller), wanted);
  }
  EXPECT_EQ(drawn(factorForTriangles(scene, view, most + 1)), most);
}

TEST(PerceptualLodTime, TakesTheLargestFactorWithinTheLimit) {
  const std::vector<double> factors = {0.0, 0.5, 1.0, 1.5, 2.0, 4.0, 8.0};
  int asked = 0;
  const auto frameMs = [&](double factor) {
    ++asked;
    return 1.0 + factor;
  };
  for (const double limit : {0.2, 1.0, 1.4, 2.0, 2.6, 4.999, 5.0, 9.0, 20.0}) {
    asked = 0;
    const TimedFactor found = factorForTime(factors, limit, frameMs);
    double wanted = 0.0;
    for (const double factor : factors)
      if (1.0 + factor <= limit) wanted = factor;
    EXPECT_EQ(found.factor, wanted) << limit;
    EXPECT_EQ(found.frameMs, 1.0 + wanted);
    EXPECT_LE(asked, 2 + 3);  // both ends, and a bisection of five between them
  }
  EXPECT_EQ(factorForTime({0.0}, 0.1, frameMs).factor, 0.0);
}

TEST_F(PerceptualLodOracle, BaselineByFrameTimeIsTimedAgainstThePipeline) {
  const scene::Scene scene =
      makeScene("lod/field", {{"grid.rows", int64_t{3}}, {"grid.columns", int64_t{3}}});
  const Given given = {{"settle_frames", int64_t{4}},
                       {"oracle", false},
                       {"match", std::string("frame_time")},
                       {"match.frames", int64_t{3}}};
  const Rendered distance = render(scene, "lod/distance_matched", given, {80, 60}, true);
  EXPECT_GT(distance.counter("perceptual_frame_ms"), 0.0);
  // Which factor it is depends on the machine's load.
  EXPECT_GE(distance.counter("distance_factor"), 0.0);
}

TEST_F(PerceptualLodOracle, BaselineDrawsNoFewerTrianglesThanThePipeline) {
  const scene::Scene scene =
      makeScene("lod/field", {{"grid.rows", int64_t{3}}, {"grid.columns", int64_t{3}}});
  const Given given = {{"settle_frames", int64_t{16}},
                       {"tests.objects_per_frame", int64_t{3}},
                       {"rule.coarsen", std::string("if_invisible")}};
  const Rendered perceptual = render(scene, "lod/perceptual", given, {80, 60}, true);
  const Rendered distance = render(scene, "lod/distance_matched", given, {80, 60}, true);
  EXPECT_GE(distance.counter("triangles_drawn"), perceptual.counter("triangles_drawn"));
  EXPECT_GT(perceptual.counter("mean_level"), 0.0);
  // What the technique shows is what it says: the ordinary picture would have as many triangles.
  EXPECT_EQ(perceptual.counter("objects_seen"), 9.0);
  EXPECT_EQ(perceptual.counter("tests_dropped"), 0.0);
}

}  // namespace
}  // namespace limen::techniques
