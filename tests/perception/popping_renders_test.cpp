// SPDX-License-Identifier: BSD-3-Clause
//
// The predictor on frames that the bench renders: spheres at several tessellations, as if their level of
// detail were switched in that frame.
#include <gtest/gtest.h>

#include <cstdlib>

#include "perception/popping/comparator.h"
#include "perception/popping/overlay.h"
#include "perception/popping/popping_gpu.h"
#include "renderer/frame/g_buffer.h"
#include "tests/gl/gl_fixture.h"
#include "tests/perception/popping_images.h"

namespace limen::perception {
namespace {

constexpr glm::ivec2 kSizePx{256, 192};

class PoppingRenders : public gl::GlTest {
 protected:
  /// Facets under one distant light: linear RGBA.
  static Image renderSpheres(int64_t tessellation) {
    const scene::SceneInfo& info = scene::SceneRegistry::instance().get("sphere_grid");
    const scene::Scene scene =
        scene::buildScene(info.name, ParameterValues(info.allParameters(), {{"tessellation", tessellation}}));
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, kSizePx);
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

}  // namespace
}  // namespace limen::perception
