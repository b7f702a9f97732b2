// SPDX-License-Identifier: BSD-3-Clause
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

class RayTracedMirrors : public ReflectionTest {};

/// A ray that leaves a convex body never meets it again: a ball alone before the background reflects the
/// background and nothing else, wherever the ball is and however fine its mesh. Where a pixel's centre is on
/// the silhouette up to rounding, the rasteriser may see the back of a facet, and rays from there are inside.
TEST_F(RayTracedMirrors, AConvexBodyNeverMeetsItself) {
  const Given given = {{"shading.background", 0.5}, {"shading.ambient", 0.0}, {"shading.diffuse", 0.0}};
  for (const double away : {0.0, 1e5})
    for (const int cells : {3, 48, 128}) {
      scene::Scene scene;
      const glm::dvec3 centre(away, 0.5 - away, 0.0);
      scene::Mesh ball = scene::sphere(centre, 0.5, cells);
      for (const glm::dvec3& position : ball.positions)
        ball.normals.emplace_back(glm::normalize(position - centre));
      scene::addPart(scene, ball, mirrorMaterial(0.8F));
      scene::setStillCamera(scene, scene::orbitCamera(centre, 2.5, 20.0, 30.0));
      const Rendered rendered = render(scene, "reflections/ray_traced", given, {192, 192});
      const std::vector<uint32_t> ids = seenTriangles(scene, {192, 192});
      const glm::dvec3 eye = scene.camera.at(0.0).eye;
      size_t onBall = 0, backs = 0;
      for (size_t i = 0; i < rendered.product.pixels(); ++i) {
        const float value = rendered.product.data[4 * i];
        if (ids[i] == frame::TriangleIds::kNone) continue;
        ++onBall;
        const glm::uvec3 of = scene.mesh.triangles[ids[i]];
        const glm::dvec3 a = scene.mesh.positions[of.x], b = scene.mesh.positions[of.y],
                         c = scene.mesh.positions[of.z];
        if (glm::dot(glm::cross(b - a, c - a), eye - a) <= 0.0) {
          ++backs;
          continue;
        }
        ASSERT_NEAR(value, 0.4, 1e-6) << "pixel " << i << " of a ball of " << cells << " at " << away;
      }
      EXPECT_GT(onBall, 3000U);
      EXPECT_LE(backs, 3U);
    }
}

/// Float against double, every pixel. A mirrored ray starts within 2^-20 of the scene's size (6 units) of the
/// true point: 6e-6, 1.2e-5 of the ball's radius and so as much in its normal, twice as much in the
/// direction, and after 6 units 1.5e-4 where it arrives. Shading changes by less than 1 a unit there
/// (Lambert's cosine over distances to the light of more than 3, halved), so that a bounce stays below 2e-4;
/// each further one between ball and floor multiplies the offset by at most 2 d / (r cos), some 20 seen as
/// here. Pixels whose rays pass within such an offset of an edge of objects, cells or shadows see another
/// side of it: on 160 x 120 pixels edges of 3000 pixels' length in all, with at most 160 px a unit, 2
/// * 1.5e-4 * 160 = 0.05 px a bounce wide: 150 pixels of bounce 1 would be far more than rounding explains,
/// as the estimate takes the largest error everywhere; 0.2 % is stated, some 40.
TEST_F(RayTracedMirrors, AgreesWithTheReferencePixelByPixel) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  for (const int bounces : {1, 2, 4})
    for (const int shadows : {0, 1}) {
      const Given given = {
          {"bounces", int64_t{bounces}}, {"shadows", int64_t{shadows}}, {"shading.specular", 0.3}};
      const Image truth = render(scene, "reflections/reference", given, {160, 120}).product;
      const Image found = render(scene, "reflections/ray_traced", given, {160, 120}).product;
      const Differing result = differing(found, truth, bounces == 1 ? 2e-4 : 4e-3);
      EXPECT_LE(result.count, 40U) << bounces << " bounces, " << shadows << " shadows";
    }
}

/// Whatever tree a ray is followed through, the nearest triangle and its distance are the same, to the last
/// bit; but for pixels that meet two triangles at the same distance, on an edge: none where edges are no
/// wider than rounding, and the shared edges of a mesh give the same colour from either side.
TEST_F(RayTracedMirrors, ATreeBuiltOnTheGpuGivesTheSamePicture) {
  for (const char* name : {"mirrors/ball", "mirrors/damaged", "mirrors/bowl"}) {
    const scene::Scene scene = makeScene(name);
    Given given = {{"bounces", int64_t{3}}, {"shadows", int64_t{1}}};
    const Image kept = render(scene, "reflections/ray_traced", given, {128, 96}).product;
    for (const char* tree : {"rebuilt", "refitted"})
      for (const int64_t bits : {30, 48, 63}) {
        given["tree"] = std::string(tree);
        given["tree.code_bits"] = bits;
        const Image found = render(scene, "reflections/ray_traced", given, {128, 96}).product;
        EXPECT_LE(differing(found, kept, 0.0).count, 12U) << name << ", " << tree << ", " << bits;
      }
  }
}

}  // namespace
}  // namespace limen::techniques
