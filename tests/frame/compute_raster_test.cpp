// SPDX-License-Identifier: BSD-3-Clause
// The compute rasteriser against the driver's, a second implementation of the same coverage.
#include "renderer/frame/compute_raster.h"

#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shadow_map.h"
#include "tests/gl/gl_fixture.h"

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
