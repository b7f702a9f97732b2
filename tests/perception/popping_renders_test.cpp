// SPDX-License-Identifier: BSD-3-Clause
//
// The predictor on frames that the bench renders: spheres at several tessellations, as if their level of
// detail were switched in that frame.
#include <gtest/gtest.h>

#include <cstdlib>

#include "perception/popping/comparator.h"
#include "perception/popping/overlay.h"
#include "perception/popping/popping_gpu.h"
#include "perception/popping/weights.h"
#include "perception/popping/weights_gpu.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/lod_pair.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/perception/popping_images.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::perception {
namespace {

constexpr glm::ivec2 kSizePx{256, 192};

class PoppingRenders : public gl::GlTest {
 protected:
  /// Facets under one distant light: linear RGBA.
  static Image renderSpheres(int64_t tessellation) {
    const scene::SceneInfo& info = scene::SceneRegistry::instance().get("sphere_grid");
    const frame::SceneOnGpu onGpu(scene::buildScene(
        info.name, ParameterValues(info.allParameters(), {{"tessellation", tessellation}})));
    frame::Frame frame(context(), onGpu, kSizePx);
    frame.begin();
    const Image normal =
        frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Normal}).texture().read();
    const Image albedo =
        frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Albedo}).texture().read();
    frame.end();
    const glm::vec3 towardsLight = glm::normalize(glm::vec3(0.4F, 0.8F, 0.5F));
    Image out(kSizePx.x, kSizePx.y, 4, 1.0F);
    for (int y = 0; y < kSizePx.y; ++y)
      for (int x = 0; x < kSizePx.x; ++x) {
        const glm::vec3 n(normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2));
        const float light = 0.1F + 0.9F * std::max(0.0F, glm::dot(n, towardsLight));
        for (int c = 0; c < 3; ++c) out.at(x, y, c) = albedo.at(x, y, c) * light;
      }
    return out;
  }
};

TEST_F(PoppingRenders, CoarserSpheresPopMoreAndTheGpuAgrees) {
  const Image finest = renderSpheres(48);
  gl::Texture actual(gl::Format::RGBA32F, kSizePx), predicted(gl::Format::RGBA32F, kSizePx);
  actual.write(finest);
  PoppingPredictorGpu predictor(context(), kSizePx, studyDisplay());
  double previous = 1e9, previousMean = 1e9;
  for (const int64_t tessellation : {3, 6, 12, 24}) {
    SCOPED_TRACE(tessellation);
    const Image coarse = renderSpheres(tessellation);
    const PoppingInput in = linearPair(finest, coarse);
    const PoppingResult result = predictPopping(in, studyDisplay());
    EXPECT_LT(result.summary.meanJnd, previousMean);
    EXPECT_LE(result.summary.largestRating, previous);
    previous = result.summary.largestRating, previousMean = result.summary.meanJnd;
    if (tessellation == 3) {
      // Silhouettes of octagons against spheres of some 20 pixels: nobody misses that.
      EXPECT_GT(result.summary.largestRating, 3.0);
      EXPECT_GT(largestColourDifference(in, studyDisplay()).value, 10.0);
    }

    predicted.write(coarse);
    PoppingGpuInput input;
    input.actual = &actual, input.predicted = &predicted;
    predictor.run(input);
    const Image jnd = predictor.jnd().read();
    double worst = 0.0;
    int64_t ties = 0;
    for (size_t p = 0; p < jnd.data.size(); ++p) {
      const double exact = result.jndExact[p];
      worst = std::max(worst, std::abs(jnd.data[p] - exact) / std::max(exact, 0.1));
      ties += std::abs(exact - 2.0) < 4e-4;
    }
    EXPECT_LT(worst, 1e-3);
    const RegionMap regions = predictor.readRegions();
    if (ties == 0) {
      EXPECT_EQ(regions.labels, result.regions.labels);
    }
    ASSERT_GT(regions.regions.size(), 0U);
    // Pixels near the threshold may fall to either side and join regions; what is seen is the same.
    EXPECT_NEAR(regions.regions.front().rating, result.regions.regions.front().rating,
                ties == 0 ? 1e-3 : 0.1);

    if (const char* folder = std::getenv("LIMEN_TEST_PICTURES")) {
      Image context = coarse;
      for (float& value : context.data) value = std::pow(std::clamp(value, 0.0F, 1.0F), 1.0F / 2.2F);
      writePng(std::string(folder) + "/popping_" + std::to_string(tessellation) + ".png",
               poppingOverlay(context, result.regions));
    }
  }
}

// All that the bench offers to the predictor, from one change of level: both frames, displacement,
// disocclusion from both depth maps, flicker. Every step on the GPU, held against every step on the CPU.
TEST_F(PoppingRenders, ChangeOfLevelRunsThroughAllSteps) {
  scene::LodSet set;
  set.name = "ball";
  for (const int cells : {16, 3})
    set.levels.push_back({scene::sphere(glm::dvec3(0.0), 1.0, cells), 0.0, 0.0});
  scene::Scene scene;
  scene::addPart(scene, "wall", scene::card({0.0, 0.0, -3.0}, {20.0, 0.0, 0.0}, {0.0, 20.0, 0.0}),
                 glm::vec3(0.3F));
  scene::addLodObject(scene, set, {}, {"ball", glm::vec3(0.8F)}, {5.0});
  scene.lights = {scene::lightTowards({-30.0, 50.0, 40.0}, glm::dvec3(0.0), glm::dvec2(1.0))};
  scene::Camera from, to;
  from.eye = {-9.0, 0.0, 5.0}, from.target = {-9.0, 0.0, 0.0};
  to.eye = {9.0, 0.0, 5.0}, to.target = {9.0, 0.0, 0.0};
  scene.camera.keys = {{0.0, from}, {1.0, to}};

  constexpr glm::ivec2 kSize{128, 96};
  const frame::SceneOnGpu onGpu(std::move(scene));
  frame::Frame frame(context(), onGpu, kSize, 0.5);
  frame::LodPair pair(frame, {});
  const auto [actualLevels, predictedLevels] = frame::objectChange(scene::finestLevels(onGpu.scene), 0, 0, 1);
  pair.setLevels(actualLevels, predictedLevels);
  frame.begin();
  pair.render();
  frame.end();

  const PoppingSettings settings;
  const frame::LodPair::View &now = pair.actual(), &kept = pair.predicted();
  const gl::Texture disocclusion(gl::Format::R32F, kSize), flicker(gl::Format::R32F, kSize);
  PoppingWeightsGpu weights(context(), settings);
  weights.disocclusion({{now.previousDepth, now.displacement, now.depthBefore},
                        {kept.previousDepth, kept.displacement, kept.depthBefore}},
                       disocclusion);
  weights.flicker({now.colour, kept.colour, now.shadedBefore, pair.previousColour(), now.displacement,
                   now.previousDepth, kept.depthBefore},
                  flicker);
  PoppingGpuInput input;
  input.actual = now.colour, input.predicted = kept.colour;
  input.actualDisplacement = now.displacement, input.predictedDisplacement = kept.displacement;
  input.disocclusion = &disocclusion, input.flicker = &flicker;
  PoppingPredictorGpu predictor(context(), kSize, studyDisplay(), settings);
  predictor.run(input);

  PoppingInput in = linearPair(now.colour->read(), kept.colour->read());
  in.actualDisplacement = now.displacement->read();
  in.predictedDisplacement = kept.displacement->read();
  in.disocclusion =
      disocclusionWeight({{now.previousDepth->read(), in.actualDisplacement, now.depthBefore->read()},
                          {kept.previousDepth->read(), in.predictedDisplacement, kept.depthBefore->read()}},
                         settings.disocclusionSettings());
  in.flicker =
      flickerWeight({in.actual, in.predicted, now.shadedBefore->read(), pair.previousColour()->read(),
                     in.actualDisplacement, now.previousDepth->read(), kept.depthBefore->read()},
                    settings.flickerSettings());
  const PoppingResult result = predictPopping(in, studyDisplay(), settings);

  const Image seen = disocclusion.read(), jnd = predictor.jnd().read();
  int64_t hidden = 0, entered = 0, apart = 0;
  for (size_t p = 0; p < jnd.data.size(); ++p) {
    (p % kSize.x < 110 ? hidden : entered) += seen.data[p] == 0.0F;
    // Where a depth lies at the tolerance, or flicker at its limit, single precision may decide otherwise.
    apart += std::abs(jnd.data[p] - result.jndExact[p]) > 1e-3 * std::max(result.jndExact[p], 0.1);
  }
  EXPECT_LE(apart, 3);
  // The camera passes at 0.3 a frame. A point at distance d moves by 0.3 / d of the focal length, which is
  // that of 96 rows: the wall (d = 8) comes in by some 4 columns at the edge, and the ball (d = 4 to 5)
  // uncovers some 2 columns of wall over its height of about 40 rows.
  EXPECT_GE(entered, 96 * 2);
  EXPECT_LE(entered, 96 * 8);
  EXPECT_GE(hidden, 20);
  EXPECT_LE(hidden, 60 * 5);
  ASSERT_FALSE(result.regions.regions.empty());
  const RegionMap regions = predictor.readRegions();
  ASSERT_FALSE(regions.regions.empty());
  EXPECT_NEAR(regions.regions.front().rating, result.regions.regions.front().rating, 0.05);
  // Nothing pops where nothing differs: all seeds lie on the ball.
  EXPECT_LT(result.summary.coverage, 0.35);
}

}  // namespace
}  // namespace limen::perception
