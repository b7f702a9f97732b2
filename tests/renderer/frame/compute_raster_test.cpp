// SPDX-License-Identifier: BSD-3-Clause
// The compute rasteriser against the driver's, a second implementation of the same coverage.
#include "renderer/frame/compute_raster.h"

#include <array>
#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/scene/shapes.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

class ComputeRasterTest : public gl::GlTest {
 protected:
  struct View {
    std::vector<uint32_t> ids;
    Image shadow;
  };

  View render(const scene::Scene& scene, Raster raster, int shadowResolution) {
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, {121, 83}, 0.0, raster);
    frame.begin();
    View view;
    view.ids = frame.get<TriangleIds>().texture().readUint();
    view.shadow = frame.get<ShadowMap>(ShadowMapSettings{shadowResolution, raster}).texture().read();
    frame.end();
    return view;
  }

  static double differingShare(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
    size_t differing = 0;
    for (size_t i = 0; i < a.size(); ++i) differing += a[i] != b[i];
    return static_cast<double>(differing) / static_cast<double>(a.size());
  }
};

TEST_F(ComputeRasterTest, SeesWhatTheDriverSees) {
  // Edges within the driver's sub-pixel step (1/256 px) of a centre may fall either way: of a picture full of
  // small triangles that is a few per mille.
  for (const char* name : {"sphere_grid", "columns_hall", "cornell_box", "two_boxes", "comb"}) {
    const scene::Scene scene = scene::buildScene(name, {});
    const View hardware = render(scene, Raster::Hardware, 128), compute = render(scene, Raster::Compute, 128);
    EXPECT_LT(differingShare(hardware.ids, compute.ids), 0.01) << name;
    int differing = 0;
    for (size_t i = 0; i < hardware.shadow.data.size(); ++i) {
      const double a = hardware.shadow.data[i], b = compute.shadow.data[i];
      if (std::abs(a - b) > 1e-4 * std::min(a, b)) ++differing;
    }
    EXPECT_LT(differing, 0.01 * static_cast<double>(hardware.shadow.data.size())) << name;
  }
}

TEST_F(ComputeRasterTest, NeedsNoClippingForTrianglesThatReachBehindTheEye) {
  // A camera low over the ground, amid the columns: ground and columns go on behind it.
  scene::Scene scene = scene::buildScene("columns_hall", {});
  const scene::Bounds bounds = scene.casterBounds();
  scene::Camera camera;
  camera.eye = bounds.centre();
  camera.eye.y = bounds.low.y + 0.02 * (bounds.high.y - bounds.low.y);
  camera.target = camera.eye + glm::dvec3(1.0, 0.05, 0.7);
  scene.camera.keys = {{0.0, camera}};
  const View hardware = render(scene, Raster::Hardware, 64), compute = render(scene, Raster::Compute, 64);
  EXPECT_LT(differingShare(hardware.ids, compute.ids), 0.01);
}

/// Depth and index in 64 bits against two passes, which a device without such atomic operations takes.
TEST_F(ComputeRasterTest, PackedSearchSeesWhatTwoPassesSee) {
  if (!ComputeRaster::canPack()) GTEST_SKIP() << "no atomic operations on 64 bits here";
  for (const char* name : {"sphere_grid", "columns_hall", "cornell_box", "comb"}) {
    const scene::Scene scene = scene::buildScene(name, {});
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, {121, 83});
    const ComputeRaster two(context(), frame.sizePx(), {.ids = true, .search = TriangleSearch::TwoPasses}),
        packed(context(), frame.sizePx(), {.ids = true, .search = TriangleSearch::Packed});
    for (int again = 0; again < 2; ++again)  // buffers are left as the next frame needs them
      for (const ComputeRaster* raster : {&two, &packed})
        raster->draw(gpuScene, anchorToClip(frame), nearPlane(frame));
    EXPECT_EQ(two.ids().readUint(), packed.ids().readUint()) << name;
    EXPECT_EQ(two.depth().read().data, packed.depth().read().data) << name;
  }
}

/// Triangle that the ray of a pixel meets first, in double precision; none where the ray passes an edge or
/// two depths too closely to tell in single precision.
struct Hit {
  uint32_t id = TriangleIds::kNone;
  bool certain = true;
};

Hit firstHit(const std::vector<std::array<glm::dvec3, 3>>& triangles, glm::dvec3 ray) {
  constexpr double kDoubt = 3e-6;
  Hit hit;
  double nearest = 1e300, second = 1e300;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    const glm::dvec3 weights(glm::dot(ray, glm::cross(b, c)), glm::dot(ray, glm::cross(c, a)),
                             glm::dot(ray, glm::cross(a, b)));
    const double sum = weights.x + weights.y + weights.z;
    if (sum == 0.0) continue;
    const glm::dvec3 share = weights / sum;
    const double reach = std::max(
        {glm::length(a) * glm::length(b), glm::length(b) * glm::length(c), glm::length(c) * glm::length(a)});
    const double least = std::min({weights.x / sum, weights.y / sum, weights.z / sum});
    const double depth = -(share.x * a.z + share.y * b.z + share.z * c.z);
    const double doubt = kDoubt * reach * glm::length(ray) / std::abs(sum);
    if (least < -doubt || !(depth > 0.0)) continue;
    if (least < doubt) hit.certain = false;
    if (depth < nearest) {
      second = nearest, nearest = depth;
      hit.id = static_cast<uint32_t>(i);
    } else {
      second = std::min(second, depth);
    }
  }
  if (hit.id != TriangleIds::kNone && second - nearest < 1e-4 * nearest) hit.certain = false;
  return hit;
}

TEST_F(ComputeRasterTest, LongThinHugeAndReceding) {
  // Slivers across the picture, in all directions, triangles of many pictures' size and such as go on behind
  // the eye: what the bands of large triangles leave out of a row must be what they do not cover.
  scene::Scene scene;
  scene::Random random(7);
  const auto add = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const auto first = static_cast<uint32_t>(scene.mesh.positions.size());
    scene.mesh.positions.insert(scene.mesh.positions.end(), {a, b, c});
    scene.mesh.triangles.emplace_back(first, first + 1, first + 2);
  };
  const auto anywhere = [&](double reach) {
    return glm::dvec3(random.uniform(-reach, reach), random.uniform(-reach, reach),
                      random.uniform(-reach, 3.0));
  };
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 from = anywhere(3.0), to = anywhere(3.0);
    add(from, to, to + 0.02 * random.direction());
  }
  for (int i = 0; i < 12; ++i) add(anywhere(3.0), anywhere(3.0), anywhere(3.0));
  for (int i = 0; i < 6; ++i)  // past the eye at z = 5
    add({random.uniform(-9.0, 9.0), -2.0 - i, 50.0}, {random.uniform(-9.0, 9.0), -2.0 - i, 40.0},
        {random.uniform(-2.0, 2.0), -1.0 - 0.1 * i, -30.0});
  scene.parts.push_back({"all", 0, static_cast<uint32_t>(scene.mesh.triangles.size())});
  scene.materials.emplace_back();
  scene.lights.emplace_back();
  scene.camera.keys = {{0.0, scene::Camera{}}};
  const View view = render(scene, Raster::Compute, 64);

  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, {121, 83}, 0.0, Raster::Compute);
  std::vector<std::array<glm::dvec3, 3>> triangles;
  for (const auto& triangle : scene.mesh.triangles) {
    std::array<glm::dvec3, 3>& corners = triangles.emplace_back();
    for (int k = 0; k < 3; ++k)
      corners[static_cast<size_t>(k)] =
          frame.anchorToCamera() * glm::dvec4(scene.mesh.positions[triangle[k]] - gpuScene.anchor(), 1.0);
  }
  size_t certain = 0;
  for (int y = 0; y < 83; ++y)
    for (int x = 0; x < 121; ++x) {
      const glm::dvec2 ndc(2.0 * (x + 0.5) / 121 - 1.0, 1.0 - 2.0 * (y + 0.5) / 83);
      const Hit hit = firstHit(
          triangles, {ndc.x * frame.tanHalfFov() * frame.aspect(), ndc.y * frame.tanHalfFov(), -1.0});
      if (!hit.certain) continue;
      ++certain;
      ASSERT_EQ(view.ids[static_cast<size_t>(y) * 121 + x], hit.id) << x << ", " << y;
    }
  EXPECT_GT(certain, size_t{121 * 83 * 9 / 10});
}

TEST_F(ComputeRasterTest, TrianglesThatShareEdgesLeaveNoCracks) {
  // From straight above, a finely cut ground fills the whole picture.
  scene::Scene scene = scene::buildScene("half_plane", {});
  scene::Camera camera;
  camera.eye = {0.3, 1.9, 0.2};
  camera.target = {0.31, 0.0, 0.21};
  camera.up = {0.0, 0.0, 1.0};
  scene.camera.keys = {{0.0, camera}};
  for (const uint32_t id : render(scene, Raster::Compute, 64).ids) ASSERT_NE(id, TriangleIds::kNone);
}

TEST_F(ComputeRasterTest, DegenerateTrianglesShowNothingAndHarmNothing) {
  const scene::Scene scene = scene::buildScene("degenerate_soup", {});
  const View hardware = render(scene, Raster::Hardware, 64), compute = render(scene, Raster::Compute, 64);
  // Coincident triangles may win either way; the rest must agree.
  EXPECT_LT(differingShare(hardware.ids, compute.ids), 0.05);
  for (const float z : compute.shadow.data) ASSERT_TRUE(std::isfinite(z) && z > 0.0F);
}

}  // namespace
}  // namespace limen::frame
