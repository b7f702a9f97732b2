// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class CameraViewPictures : public TechniqueTest {
 protected:
  static constexpr glm::ivec2 kSize{96, 64};
  static Image seen(const scene::Scene& scene, const char* kind, Given given) {
    given["seen"] = std::string(kind);
    if (std::string(kind) == "cuts") given["seen.levels"] = int64_t{16};
    return render(scene, "many_lods/camera_views", given, kSize).product;
  }
  /// Triangles drawn for another camera, by a technique that knows nothing of views.
  static Image drawn(scene::Scene scene, glm::dvec3 eye, glm::dvec3 target, glm::ivec2 sizePx) {
    for (scene::CameraPath::Key& key : scene.camera.keys) {
      key.camera.eye = eye;
      key.camera.target = target;
    }
    return render(scene, "antialiasing/one_sample", {}, sizePx).product;
  }
  static scene::Camera cameraOf(const scene::Scene& scene) { return scene.camera.keys.front().camera; }
  static void add(Image& sum, const Image& of, float share) {
    for (size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += share * of.data[i];
  }
};

// Rays and triangles meet the same surfaces through pixels' middles, but for single pixels at outlines.
TEST_F(CameraViewPictures, StereoPairsAreTwoCamerasPictures) {
  const scene::Scene scene = makeScene("sphere_grid");
  const scene::Camera camera = cameraOf(scene);
  const glm::dvec3 forwards = camera.target - camera.eye;
  const glm::dvec3 half = 0.05 * glm::length(forwards) * glm::normalize(glm::cross(forwards, camera.up));
  const Given given = {{"views", std::string("stereo")}, {"views.separation", 0.1}};
  const Image rays = seen(scene, "rays", given);
  Image pair(kSize.x, kSize.y, 4);
  for (const int side : {0, 1}) {
    const glm::dvec3 by = side == 0 ? -half : half;
    const Image one = drawn(scene, camera.eye + by, camera.target + by, {kSize.x / 2, kSize.y});
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x / 2; ++x)
        for (int c = 0; c < 4; ++c) pair.at(side * kSize.x / 2 + x, y, c) = one.at(x, y, c);
  }
  const Image flat = drawn(scene, camera.eye, camera.target, kSize);
  EXPECT_LT(meanDifference(rays, pair), 1e-3);
  EXPECT_GT(meanDifference(flat, pair), 1e-2);
}

TEST_F(CameraViewPictures, ShuttersAreMeansOverCameras) {
  const scene::Scene scene = makeScene("sphere_grid");
  const scene::Camera camera = cameraOf(scene);
  constexpr int kTimes = 8;
  const Image rays =
      seen(scene, "rays",
           {{"views", std::string("shutter")}, {"views.turn", 12.0}, {"views.samples", int64_t{kTimes}}});
  Image mean(kSize.x, kSize.y, 4);
  const glm::dvec3 up = glm::normalize(camera.up), from = camera.eye - camera.target;
  for (int i = 0; i < kTimes; ++i) {
    const double angle = 12.0 / 180.0 * std::numbers::pi * ((i + 0.5) / kTimes - 0.5);
    // Rodrigues' formula.
    const glm::dvec3 turned = from * std::cos(angle) + glm::cross(up, from) * std::sin(angle) +
                              up * glm::dot(up, from) * (1.0 - std::cos(angle));
    add(mean, drawn(scene, camera.target + turned, camera.target, kSize), 1.0F / kTimes);
  }
  EXPECT_LT(meanDifference(rays, mean), 1e-3);
  EXPECT_GT(meanDifference(drawn(scene, camera.eye, camera.target, kSize), mean), 5e-3);
}

// A lens blurs a point at distance d by its radius times |1 / d - 1 / focus| on a plane at distance 1: what
// is in focus is as sharp as through a pinhole, and all else is less sharp the farther it is from there.
TEST_F(CameraViewPictures, LensesAreSharpInTheirPlaneAlone) {
  // A large triangle with its edge through the middle of the picture, facing the camera.
  scene::Scene scene = makeScene("sphere_grid");
  const scene::Camera camera = cameraOf(scene);
  const glm::dvec3 forwards = camera.target - camera.eye;
  const double distance = glm::length(forwards);
  const glm::dvec3 right = glm::normalize(glm::cross(forwards, camera.up));
  const glm::dvec3 up = glm::normalize(glm::cross(right, forwards));
  scene.mesh.positions = {camera.target - 10.0 * distance * up, camera.target + 10.0 * distance * right,
                          camera.target + 10.0 * distance * up};
  scene.mesh.triangles = {{0, 1, 2}};
  scene.mesh.normals.clear();
  scene.mesh.attributes.clear();
  scene.parts.resize(1);
  scene.parts[0].firstTriangle = 0;
  scene.parts[0].triangleCount = 1;
  scene.motions.clear();
  const double radius = 0.05, pxOfTangent = 0.5 * kSize.y / std::tan(glm::radians(camera.verticalFovDeg) / 2);
  for (const double focus : {1.0, 2.0, 0.5}) {
    const Image rays = seen(scene, "rays",
                            {{"views", std::string("lens")},
                             {"views.radius", radius},
                             {"views.focus", focus},
                             {"views.samples", int64_t{64}}});
    const int y = kSize.y / 2;
    const double dark = rays.at(2, y, 1), bright = rays.at(kSize.x - 3, y, 1);
    ASSERT_GT(std::abs(bright - dark), 0.05);
    int between = 0;
    for (int x = 0; x < kSize.x; ++x) {
      const double share = (rays.at(x, y, 1) - dark) / (bright - dark);
      between += share > 0.01 && share < 0.99 ? 1 : 0;
    }
    const double blurPx = 2.0 * radius * std::abs(1.0 - 1.0 / focus) * pxOfTangent;
    EXPECT_NEAR(between, blurPx, 1.5 + 0.2 * blurPx) << "focus " << focus;
  }
}

// Views of points are as far from those of triangles as points in one view are, whose outlines they share.
TEST_F(CameraViewPictures, OfPointsErrAsPointsDo) {
  const scene::Scene scene = makeScene("sphere_grid");
  const double one = meanDifference(
      render(scene, "many_lods/points", {{"levels", int64_t{16}}}, {kSize.x / 2, kSize.y}).product,
      render(scene, "antialiasing/one_sample", {}, {kSize.x / 2, kSize.y}).product);
  ASSERT_GT(one, 0.0);
  for (const char* views : {"stereo", "lens", "shutter"}) {
    const Given given = {{"views", std::string(views)}};
    EXPECT_LT(meanDifference(seen(scene, "cuts", given), seen(scene, "rays", given)), 1.25 * one) << views;
  }
}

}  // namespace
}  // namespace limen::techniques
