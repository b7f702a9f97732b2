// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "renderer/frame/frame_bindings.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

class ShadowMapTest : public gl::GlTest {};

constexpr double kLimitTangent = 3.7320508075688772;  // 75 degrees

TEST_F(ShadowMapTest, TheFittedFrustumHoldsEveryCasterItMaySee) {
  for (const char* name :
       {"two_boxes", "sphere_grid", "pole", "comb", "box_under_light", "half_plane", "card_stack"}) {
    const scene::Scene scene = builtScene(name);
    const scene::AreaLight& light = scene.lights[0];
    const LightCasters casters(scene);
    for (const glm::dvec2 unit :
         {glm::dvec2(0.5), glm::dvec2(0.0), glm::dvec2(1.0, 0.0), glm::dvec2(0.3, 1.0)}) {
      const glm::dvec2 offset = (unit - 0.5) * light.size;
      const LightFrustum frustum = casters.fit(offset, 64);
      const glm::dvec2 texel = (frustum.high - frustum.low) / 64.0;
      double tightest = 1e9;
      for (const scene::Part& part : scene.parts) {
        if (part.receiverOnly) continue;
        for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
          for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 d = scene.mesh.positions[scene.mesh.triangles[i][corner]] - light.point(unit);
            const double z = glm::dot(d, light.direction());
            if (z <= 0.0) continue;
            EXPECT_GT(z, frustum.near) << name;
            const glm::dvec2 tangent = glm::dvec2(glm::dot(d, light.axisX), glm::dot(d, light.axisY)) / z;
            for (int axis = 0; axis < 2; ++axis) {
              if (std::abs(tangent[axis]) > kLimitTangent) continue;
              // A texel's margin on each side, and no more than that on the tightest side.
              EXPECT_GE(tangent[axis], frustum.low[axis] + 0.99 * texel[axis]) << name;
              EXPECT_LE(tangent[axis], frustum.high[axis] - 0.99 * texel[axis]) << name;
              tightest = std::min(tightest, (tangent[axis] - frustum.low[axis]) / texel[axis]);
            }
          }
      }
      if (std::string(name) != "half_plane") {
        EXPECT_LE(tightest, 1.01) << name;
      }
    }
  }
}

/// Light-space depths that rays through texel (x, y) find at its centre and within the raster's snapping.
std::pair<double, double> depthRange(const BruteForce& truth, const scene::AreaLight& light,
                                     glm::dvec3 anchor, const LightFrustum& frustum, int resolution, int x,
                                     int y) {
  std::pair<double, double> range(1e300, -1e300);
  const auto look = [&](glm::dvec2 offset) {
    const glm::dvec2 u = (glm::dvec2(x, y) + 0.5 + offset) / double(resolution);
    const glm::dvec2 tangent = frustum.low + u * (frustum.high - frustum.low);
    const glm::dvec3 eye =
        light.centre + light.axisX * frustum.offset.x + light.axisY * frustum.offset.y - anchor;
    const Hit hit =
        truth.trace(eye, light.axisX * tangent.x + light.axisY * tangent.y + light.direction(), frustum.near);
    const double z = std::min(hit.t, double(kEmptyDepth));
    range = {std::min(range.first, z), std::max(range.second, z)};
  };
  look(glm::dvec2(0.0));
  for (const glm::dvec2 offset : snappingOffsets()) look(offset);
  return range;
}

TEST_F(ShadowMapTest, DepthsAreThoseOfRaysThroughTheTexelsCentres) {
  constexpr int kResolution = 32;
  for (const char* name : {"two_boxes", "pole"})
    for (const double scale : {1.0, 1e-4, 1e4}) {
      const scene::Scene scene = builtScene(name, {{"scale", scale}});
      const GpuScene gpuScene(scene);
      Frame frame(context(), scene, gpuScene, {8, 8});
      frame.begin();
      const ShadowMap& map = frame.get<ShadowMap>(ShadowMapSettings{kResolution});
      const Image linear = map.texture().read();
      frame.end();
      const BruteForce truth(scene, gpuScene.anchor());
      for (int y = 0; y < kResolution; ++y)
        for (int x = 0; x < kResolution; ++x) {
          const auto [low, high] =
              depthRange(truth, scene.lights[0], gpuScene.anchor(), map.frustum(), kResolution, x, y);
          EXPECT_GE(linear.at(x, y), low * (1.0 - 1e-5)) << name << ' ' << x << ' ' << y;
          EXPECT_LE(linear.at(x, y), high * (1.0 + 1e-5)) << name << ' ' << x << ' ' << y;
        }
    }
}

TEST_F(ShadowMapTest, ThePyramidHoldsMinimumAndMaximumOfItsTexels) {
  for (const int resolution : {1, 2, 4, 8, 16, 64, 256}) {
    const scene::Scene scene = builtScene("two_boxes");
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, {8, 8});
    frame.begin();
    const ShadowMapSettings settings{resolution};
    const Image linear = frame.get<ShadowMap>(settings).texture().read();
    const MinMaxPyramid& pyramid = frame.get<MinMaxPyramid>(settings);
    int levels = 1;
    while ((resolution >> levels) > 0) ++levels;
    ASSERT_EQ(pyramid.levels(), levels);
    EXPECT_EQ(pyramid.minimum().read(0).data, linear.data) << resolution;
    for (int level = 1; level < levels; ++level) {
      const Image minimum = pyramid.minimum().read(level), maximum = pyramid.maximum().read(level - 1);
      const int side = resolution >> level, span = 1 << level;
      ASSERT_EQ(minimum.width, side);
      ASSERT_EQ(maximum.width, side);
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          float low = 2e30F, high = -2e30F;
          for (int dy = 0; dy < span; ++dy)
            for (int dx = 0; dx < span; ++dx) {
              low = std::min(low, linear.at(x * span + dx, y * span + dy));
              high = std::max(high, linear.at(x * span + dx, y * span + dy));
            }
          ASSERT_EQ(minimum.at(x, y), low) << resolution << " level " << level;
          ASSERT_EQ(maximum.at(x, y), high) << resolution << " level " << level;
        }
    }
    frame.end();
  }
}

TEST_F(ShadowMapTest, ASceneWithoutCastersStillHasAMap) {
  scene::Scene scene = builtScene("two_boxes");
  for (scene::Part& part : scene.parts) part.receiverOnly = true;
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, {8, 8});
  frame.begin();
  for (const float z : frame.get<ShadowMap>(ShadowMapSettings{16}).texture().read().data) {
    EXPECT_TRUE(std::isfinite(z));
    EXPECT_GT(z, 0.0F);
  }
  frame.end();
}

}  // namespace
}  // namespace limen::frame
