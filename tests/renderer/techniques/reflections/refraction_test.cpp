// SPDX-License-Identifier: BSD-3-Clause
// Refraction where its outcome is known in closed form: total reflection in a prism, a slab with parallel
// faces, media alike.
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

class Refraction : public ReflectionTest {
 protected:
  static scene::Material glass(double index) {
    scene::Material material = mirrorMaterial(0.0F);
    material.name = "glass";
    material.albedo = glm::vec3(0.0F);
    material.transmittance = glm::vec3(0.5F);
    material.refractiveIndex = static_cast<float>(index);
    return material;
  }
  /// Surfaces show their albedo; there is no light.
  static Given following(int64_t bounces) {
    return {{"bounces", bounces},
            {"refraction", true},
            {"shading.ambient", 1.0},
            {"shading.diffuse", 0.0},
            {"shading.background", 0.25}};
  }
  static constexpr glm::ivec2 kSize{32, 24};
  static constexpr const char* kTechniques[] = {"reflections/ray_traced", "reflections/ray_hierarchy",
                                                "reflections/reference"};
};

/// Through a leg of a prism with angles of 45 degrees, totally reflected by its long side (the critical angle
/// of 1.5 is 41.8 degrees), out of the other leg: the two surfaces that let light through leave a quarter,
/// the long side takes nothing. The view is 2 degrees wide, and so the angles at the long side lie
/// between 44.3 and 45.7 degrees. To the right is a red wall, behind a green one.
TEST_F(Refraction, APrismReflectsTotally) {
  scene::Scene scene;
  scene::Mesh prism;
  // Legs: z = 0.5, seen, and x = 0.5; the long side between (-0.5, 0.5) and (0.5, -0.5).
  for (const double y : {-0.5, 0.5})
    for (const glm::dvec2 p : {glm::dvec2(-0.5, 0.5), {0.5, 0.5}, {0.5, -0.5}})
      prism.positions.emplace_back(p.x, y, p.y);
  prism.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  for (const bool isGlass : {true, false}) {
    scene = {};
    scene::addPart(scene, prism, glass(1.5));
    scene::addPart(scene, "right", scene::card({3.0, 0.0, 0.0}, {0.0, 0.0, 3.0}, {0.0, 3.0, 0.0}),
                   {0.8F, 0.0F, 0.0F});
    scene::addPart(scene, "behind", scene::card({0.0, 0.0, -3.0}, {3.0, 0.0, 0.0}, {0.0, 3.0, 0.0}),
                   {0.0F, 0.6F, 0.0F});
    scene::addPart(scene, scene::card({0.0, 9.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}),
                   mirrorMaterial(0.5F));
    scene::setStillCamera(scene, {{0.1, 0.0, 4.0}, {0.1, 0.0, 0.0}, {0.0, 1.0, 0.0}, 2.0});
    // Of an index that bends little the long side reflects nothing: two surfaces are passed.
    scene.materials[0].refractiveIndex = isGlass ? 1.5F : 1.01F;
    const glm::dvec3 expected =
        isGlass ? glm::dvec3(0.25 * double(0.8F), 0.0, 0.0) : glm::dvec3(0.0, 0.25 * double(0.6F), 0.0);
    for (const char* technique : kTechniques) {
      const Image found = render(scene, technique, following(3), kSize).product;
      for (size_t i = 0; i < found.pixels(); ++i)
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(found.data[4 * i + size_t(c)], expected[c], 1e-6) << technique << ", pixel " << i;
    }
  }
}

/// Parallel faces shift a ray and bend it not at all: through a slab of any index, at any angle, a far
/// checker is seen as without it, but shifted by less than the slab's thickness; a wall of one colour as it
/// is, times the share that two faces let through.
TEST_F(Refraction, ParallelFacesLeaveTheDirection) {
  for (const double index : {1.0, 1.5, 2.4}) {
    scene::Scene scene;
    scene::addPart(scene, scene::box({-2.0, -2.0, -0.1}, {2.0, 2.0, 0.1}), glass(index));
    // From z = 4 at 0.35 rad at most: the border at x = 0.3 at distance 9 is seen where the ray would meet it
    // if it came from up to 0.2 tan 0.4 = 0.085 aside.
    scene::addPart(scene, "left", scene::card({-9.7, 0.0, -5.0}, {10.0, 0.0, 0.0}, {0.0, 9.0, 0.0}),
                   {0.8F, 0.0F, 0.0F});
    scene::addPart(scene, "right", scene::card({10.3, 0.0, -5.0}, {10.0, 0.0, 0.0}, {0.0, 9.0, 0.0}),
                   {0.0F, 0.6F, 0.0F});
    scene::addPart(scene, scene::card({0.0, 19.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}),
                   mirrorMaterial(0.5F));
    scene::setStillCamera(scene, {{0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 30.0});
    for (const char* technique : kTechniques) {
      const Image found = render(scene, technique, following(2), kSize).product;
      const double half = std::tan(glm::radians(15.0));
      for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
          const double at = 9.0 * (2.0 * (x + 0.5) / kSize.x - 1.0) * half * kSize.x / kSize.y;
          if (std::abs(at - 0.3) < (index == 1.0 ? 1e-3 : 0.1)) continue;
          ASSERT_NEAR(found.at(x, y, 0), at < 0.3 ? 0.25 * 0.8 : 0.0, 1e-6)
              << technique << ' ' << index << ", " << x << ' ' << y;
          ASSERT_NEAR(found.at(x, y, 1), at < 0.3 ? 0.0 : 0.25 * 0.6, 1e-6)
              << technique << ' ' << index << ", " << x << ' ' << y;
        }
    }
  }
}

/// Balls within balls, every surface a ball of radius 1, 0.9, 0.8 ...: the middle ray meets each twice head
/// on. Of `bounces` surfaces at most `bounces` are followed, and the last one passed shows its albedo alone.
TEST_F(Refraction, NestedSurfacesUpToTheLimit) {
  scene::Scene scene;
  for (int ball = 0; ball < 4; ++ball) {
    scene::Material material = glass(ball % 2 == 0 ? 1.5 : 1.0 / 1.5);
    material.name += std::to_string(ball);
    scene::addPart(scene, scene::sphere(glm::dvec3(0.0), 1.0 - 0.1 * ball, 12), material);
  }
  scene::addPart(scene, "wall", scene::card({0.0, 0.0, -3.0}, {5.0, 0.0, 0.0}, {0.0, 5.0, 0.0}),
                 {0.8F, 0.8F, 0.8F});
  scene::addPart(scene, scene::card({0.0, 9.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}), mirrorMaterial(0.5F));
  scene::setStillCamera(scene, {{0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 1.0});
  // Eight surfaces before the wall: with eight bounces it is reached, with seven nothing is.
  for (const int64_t bounces : {7, 8, 9})
    for (const char* technique : kTechniques) {
      const Image found = render(scene, technique, following(bounces), {9, 9}).product;
      EXPECT_NEAR(found.at(4, 4, 0), bounces < 8 ? 0.0 : 0.8 / 256.0, 1e-6) << technique << ", " << bounces;
    }
}

}  // namespace
}  // namespace limen::techniques
