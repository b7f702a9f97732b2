// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/mirror_rays.h"

#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

constexpr glm::ivec2 kMirrorSize{64, 48};

class MirrorRaysTest : public gl::GlTest {
 protected:
  struct Rays {
    std::vector<uint32_t> ids;
    Image origins, directions;
    glm::dvec3 eye;
  };
  static Rays raysOf(const scene::Scene& scene, const GpuScene& gpuScene) {
    Frame frame(context(), scene, gpuScene, kMirrorSize);
    frame.begin();
    const auto& rays = frame.get<MirrorRays>();
    Rays out{frame.get<TriangleIds>().texture().readUint(), rays.origins().read(), rays.directions().read(),
             glm::dvec3(glm::inverse(frame.anchorToCamera())[3])};
    frame.end();
    return out;
  }
  static glm::dvec3 at(const Image& image, size_t pixel) {
    return {image.data[4 * pixel], image.data[4 * pixel + 1], image.data[4 * pixel + 2]};
  }
};

scene::Material mirrorMaterial() {
  scene::Material material;
  material.name = "mirror";
  material.mirror = glm::vec3(0.9F);
  return material;
}

scene::Scene mirrorBall(int cells) {
  scene::Scene scene;
  scene::addGround(scene, 6.0);
  scene::Mesh ball = scene::sphere({0.0, 0.5, 0.0}, 0.5, cells);
  ball.normals.clear();
  for (const glm::dvec3& p : ball.positions)
    ball.normals.emplace_back(glm::normalize(p - glm::dvec3(0.0, 0.5, 0.0)));
  scene::addPart(scene, ball, mirrorMaterial());
  scene::frameStanding(scene, 1.0, 0.6);
  return scene;
}

/// Only what the mirror shows has rays, and they leave the sphere as geometry says: the mirrored view is in
/// the plane of view and normal, makes the same angle with the normal, and that normal is the sphere's own up
/// to the interpolation over a facet.
TEST_F(MirrorRaysTest, RaysOfASphereAreThoseOfItsNormals) {
  const scene::Scene scene = mirrorBall(32);
  const GpuScene gpuScene(scene);
  const Rays rays = raysOf(scene, gpuScene);
  const glm::dvec3 centre = glm::dvec3(0.0, 0.5, 0.0) - gpuScene.anchor();
  const scene::Part& ball = scene.parts[1];
  size_t found = 0;
  for (size_t pixel = 0; pixel < rays.ids.size(); ++pixel) {
    const uint32_t id = rays.ids[pixel];
    const bool mirror = id != TriangleIds::kNone && id >= ball.firstTriangle;
    EXPECT_EQ(rays.origins.data[4 * pixel + 3], mirror ? 1.0F : 0.0F) << pixel;
    const glm::dvec3 direction = at(rays.directions, pixel), origin = at(rays.origins, pixel);
    if (!mirror) {
      EXPECT_EQ(direction, glm::dvec3(0.0));
      continue;
    }
    ++found;
    EXPECT_NEAR(glm::length(origin - centre), 0.5, 0.5 * 1e-3) << pixel;
    const glm::dvec3 view = glm::normalize(rays.eye - origin), half = glm::normalize(view + direction);
    const glm::dvec3 normal = glm::normalize(origin - centre);
    // Near the silhouette mirrored views that would enter a facet leave it by the facet's own normal.
    const double cosine = glm::dot(view, normal);
    if (cosine < 0.15) continue;
    EXPECT_GT(glm::dot(half, normal), std::cos(0.003)) << pixel;
    EXPECT_NEAR(rays.directions.data[4 * pixel + 3], cosine, 0.005) << pixel;
  }
  EXPECT_GT(found, 200U);
}

/// No ray enters the triangle that it leaves, however coarse the mesh and far off its normals.
TEST_F(MirrorRaysTest, NoRayEntersItsOwnTriangle) {
  const scene::Scene scene = mirrorBall(2);
  const GpuScene gpuScene(scene);
  const Rays rays = raysOf(scene, gpuScene);
  const BruteForce truth(scene, gpuScene.anchor());
  size_t found = 0;
  for (size_t pixel = 0; pixel < rays.ids.size(); ++pixel) {
    if (rays.origins.data[4 * pixel + 3] == 0.0F) continue;
    ++found;
    const glm::dvec3 direction = at(rays.directions, pixel), view = rays.eye - at(rays.origins, pixel);
    glm::dvec3 normal = truth.normal(rays.ids[pixel]);
    if (glm::dot(normal, view) < 0.0) normal = -normal;
    EXPECT_NEAR(glm::length(direction), 1.0, 1e-5);
    EXPECT_GT(glm::dot(direction, normal), 0.0) << pixel;
  }
  EXPECT_GT(found, 200U);
}

TEST_F(MirrorRaysTest, MaterialsGiveTheSceneItsTraits) {
  scene::Scene scene = mirrorBall(2);
  EXPECT_TRUE(scene.traits().count("mirrors"));
  EXPECT_FALSE(scene.traits().count("glossy_materials"));
  EXPECT_FALSE(scene.traits().count("refractive_materials"));
  const std::string before = scene.contentHash();
  scene.materials[1].glossRad = 0.05F;
  scene.materials[1].transmittance = glm::vec3(0.5F);
  EXPECT_TRUE(scene.traits().count("glossy_materials"));
  EXPECT_TRUE(scene.traits().count("refractive_materials"));
  EXPECT_NE(scene.contentHash(), before);
}

}  // namespace
}  // namespace limen::frame
