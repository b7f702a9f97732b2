// SPDX-License-Identifier: BSD-3-Clause
// Blockers before the receiver's own plane, and coarse texels at the depth of one of their finest ones.
#include <cmath>
#include <glm/glm.hpp>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/sampled_pyramid.h"
#include "renderer/frame/shadow_map.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class ReceiverPlane : public TechniqueTest {
 protected:
  /// A plane that leans and nothing else: all of it sees the whole light, if the light is before it.
  static scene::Scene leaningPlane(double tilt, double lightSize) {
    scene::Scene scene = makeScene("resting_sphere", {{"tilt", tilt}, {"light_size", lightSize}});
    scene.parts.resize(1);
    scene.mesh.triangles.resize(scene.parts[0].triangleCount);
    return scene;
  }

  static double rootMeanSquare(const Image& a, const Image& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) sum += std::pow(double(a.data[i]) - b.data[i], 2.0);
    return std::sqrt(sum / double(a.data.size()));
  }
};

// 1/z on a plane is linear in the tangents: the gradient's prediction at neighbouring pixels of the plane is
// their depth.
TEST_F(ReceiverPlane, GradientPredictsTheDepthsOfItsPlane) {
  const scene::Scene scene = leaningPlane(50.0, 1.0);
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {32, 24});
  frame.begin();
  const auto& receivers = frame.get<frame::Receivers>();
  const Image points = receivers.texture().read(), planes = receivers.planes().read();
  frame.end();
  int compared = 0;
  for (int y = 0; y < points.height; ++y)
    for (int x = 1; x < points.width; ++x) {
      if (points.at(x, y, 3) < 0.0F || points.at(x - 1, y, 3) < 0.0F) continue;
      const glm::dvec3 p(points.at(x, y, 0), points.at(x, y, 1), points.at(x, y, 2)),
          q(points.at(x - 1, y, 0), points.at(x - 1, y, 1), points.at(x - 1, y, 2));
      const glm::dvec2 g(planes.at(x, y, 0), planes.at(x, y, 1)),
          away = glm::dvec2(q) / q.z - glm::dvec2(p) / p.z;
      EXPECT_NEAR(p.z / (1.0 + glm::dot(g, away)) / q.z, 1.0, 1e-5);
      ++compared;
    }
  EXPECT_GT(compared, 200);
}

// No acne at any level, tilt and size of light that leaves the light before the plane, and no bias beyond the
// constant.
TEST_F(ReceiverPlane, LeavesALeaningPlaneLit) {
  for (const char* technique : {"soft_shadows/bitmask", "soft_shadows/backprojection"})
    for (const double tilt : {0.0, 30.0, 60.0})
      for (const int64_t level : {0, 2, 4}) {
        const Rendered rendered = render(leaningPlane(tilt, 2.0), technique,
                                         {{"resolution", int64_t{128}},
                                          {"bias.slope", 0.0},
                                          {"levels", std::string("fixed")},
                                          {"levels.level", level}},
                                         {48, 36});
        // Texels of which the centre misses the plane's edge know nothing of it: 1 % of the receivers.
        int dark = 0, receivers = 0;
        for (size_t i = 0; i < rendered.product.pixels(); ++i) {
          receivers += rendered.receivers.data[4 * i + 3] >= 0.0F;
          dark += rendered.product.data[i] < 1.0F;
        }
        EXPECT_GT(receivers, 200);
        EXPECT_LE(dark, receivers / 100) << technique << ", tilt " << tilt << ", level " << level;
      }
}

// A light of which a plane sees a part: rays know that share without any map.
TEST_F(ReceiverPlane, HidesTheLightBehindIt) {
  const scene::Scene scene = leaningPlane(80.0, 24.0);
  const Image truth =
      render(scene, "soft_shadows/ray_traced", {{"samples", int64_t{1024}}}, {32, 24}).product;
  int cut = 0;
  for (const float value : truth.data) cut += value > 0.02F && value < 0.98F;
  ASSERT_GT(cut, 20);
  for (const char* pattern : {"regular_8", "regular_16", "regular_32", "jittered_16", "halton_256"}) {
    const Image product =
        render(scene, "soft_shadows/bitmask", {{"pattern", std::string(pattern)}}, {32, 24}).product;
    // A line through n x n samples leaves fewer than n undecided; the rays are 32 x 32.
    for (size_t i = 0; i < truth.pixels(); ++i)
      ASSERT_NEAR(product.data[i], truth.data[i], pattern == std::string("regular_8") ? 0.1 : 0.06)
          << pattern << ' ' << i;
  }
  const Image areas = render(scene, "soft_shadows/backprojection", {}, {32, 24}).product;
  EXPECT_LT(rootMeanSquare(areas, truth), 0.02);
}

TEST_F(ReceiverPlane, AtlasHoldsOneFinestTexelOfEachCoarseOne) {
  const scene::Scene scene = makeScene("sphere_grid");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {8, 6});
  for (const int side : {64, 256}) {
    frame.begin();
    const Image map = frame.get<frame::ShadowMap>(frame::ShadowMapSettings{side}).texture().read();
    const Image atlas = frame.get<frame::SampledPyramid>(frame::ShadowMapSettings{side}).atlas().read();
    frame.end();
    for (int level = 1, row = 0; side >> level > 0; row += side >> level, ++level) {
      double covered = 0.0, coveredByLevel = 0.0;
      for (int y = 0; y < side >> level; ++y)
        for (int x = 0; x < side >> level; ++x) {
          const float z = atlas.at(x, row + y);
          bool found = false;
          for (int j = 0; j < 1 << level; ++j)
            for (int i = 0; i < 1 << level; ++i) {
              const float fine = map.at((x << level) + i, (y << level) + j);
              found = found || fine == z;
              covered += fine < 4.0F;
            }
          EXPECT_TRUE(found) << side << ' ' << level << ' ' << x << ' ' << y;
          coveredByLevel += z < 4.0F ? double(1 << level) * (1 << level) : 0.0;
        }
      // Shares of what lies above a depth are those of the map, within three standard deviations of
      // independent samples.
      const double texels = double(side) * side, share = covered / texels,
                   count = double(side >> level) * (side >> level);
      if (count < 64) continue;
      EXPECT_NEAR(coveredByLevel / texels, share, 3.0 * std::sqrt(share * (1.0 - share) / count))
          << side << ' ' << level;
    }
  }
}

// The same on scenes whose thin and many occluders the minima of coarse levels make grow: the error falls by
// more than a third.
TEST_F(ReceiverPlane, SampledDepthsErrLessThanNearestOnes) {
  for (const char* name : {"foliage", "comb", "sphere_grid"}) {
    const scene::Scene scene = makeScene(name);
    const Image truth =
        render(scene, "soft_shadows/ray_traced", {{"samples", int64_t{256}}}, {64, 48}).product;
    const auto error = [&](const Given& given) {
      return rootMeanSquare(render(scene, "soft_shadows/bitmask", given, {64, 48}).product, truth);
    };
    const double thesis = error(inThesisForm({})),
                 nearest = error({{"occluders.depths", std::string("nearest")}}),
                 sampled = error({{"occluders.division", std::string("levels")}});
    EXPECT_LT(nearest, thesis) << name;
    EXPECT_LT(sampled, nearest) << name;
    EXPECT_LT(sampled, 0.66 * thesis) << name;
  }
}

}  // namespace
}  // namespace limen::techniques
