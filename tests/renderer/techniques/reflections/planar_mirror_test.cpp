// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/planar_mirror/mirror_planes.h"

#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

class PlanarMirrors : public ReflectionTest {};

/// One to three planes, up to five bounces: as the reference in double precision has it, except where a
/// pixel's centre is on an edge up to rounding. Positions in views are rounded to 2^-24 of some 10 units for
/// each mirroring, as are normals; a plane's image is not magnified, so that shading differs by less than
/// 1e-4. Edges within 1e-4 px of a centre: with less than 6000 px of edges in all (cells included), one
/// pixel; the rasteriser's own grid of 1/256 px moves edges by up to 1/512 px: some 12 to 24 pixels.
TEST_F(PlanarMirrors, EqualTheReferenceAtEveryBounce) {
  for (const int planes : {1, 2, 3})
    for (const int bounces : {1, 2, 3, 5}) {
      const scene::Scene scene = makeScene("mirrors/planes", {{"planes", int64_t{planes}}});
      const Given given = {{"bounces", int64_t{bounces}}};
      const Image truth = render(scene, "reflections/reference", given, {128, 96}).product;
      const Image found = render(scene, "reflections/planar_mirror", given, {128, 96}).product;
      EXPECT_LE(differing(found, truth, 1e-4).count, 24U) << planes << " planes, " << bounces << " bounces";
    }
}

/// What the test above can see: each further bounce changes the picture where mirrors face each other.
TEST_F(PlanarMirrors, BouncesAreSeen) {
  const scene::Scene scene = makeScene("mirrors/planes", {{"planes", int64_t{2}}});
  for (const int bounces : {2, 3}) {
    const Image more =
        render(scene, "reflections/planar_mirror", {{"bounces", int64_t{bounces}}}, {128, 96}).product;
    const Image fewer =
        render(scene, "reflections/planar_mirror", {{"bounces", int64_t{bounces - 1}}}, {128, 96}).product;
    EXPECT_GT(differing(more, fewer, 1e-4).count, 60U) << bounces;
  }
}

/// A mirror twice is nothing; a point of the plane stays; a normal turns.
TEST(MirrorPlanes, AMirrorsMatrixMirrors) {
  const glm::dvec4 plane(0.6, 0.0, 0.8, -2.0);
  const glm::dmat4 mirror = mirrorMatrix(plane);
  const glm::dvec4 point(1.0, -3.0, 4.0, 1.0), mirrored = mirror * point;
  EXPECT_NEAR(glm::dot(plane, point), -glm::dot(plane, mirrored), 1e-12);
  EXPECT_LT(glm::length(mirror * mirrored - point), 1e-12);
  EXPECT_LT(glm::length(glm::cross(glm::dvec3(mirrored - point), glm::dvec3(plane))), 1e-12);
}

TEST(MirrorPlanes, ThePlanesOfABoxAreItsSides) {
  scene::Scene scene;
  scene::Material material;
  material.mirror = glm::vec3(1.0F);
  scene::addPart(scene, scene::box({-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0}), material);
  const MirrorPlanes found = findMirrorPlanes(scene, {5.0, 0.0, 0.0}, 16);
  ASSERT_EQ(found.planes.size(), 6U);
  for (size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    const glm::dvec4 plane = found.planes.at(found.planeOf[t]);
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_NEAR(glm::dot(glm::dvec3(plane), scene.mesh.positions[scene.mesh.triangles[t][corner]] -
                                                  glm::dvec3(5.0, 0.0, 0.0)) +
                      plane.w,
                  0.0, 1e-12);
  }
  // The largest first: x = +-1 with 24 units of area each.
  EXPECT_EQ(std::abs(found.planes[0].x), 1.0);
  EXPECT_EQ(findMirrorPlanes(scene, {}, 2).planes.size(), 2U);
}

}  // namespace
}  // namespace limen::techniques
