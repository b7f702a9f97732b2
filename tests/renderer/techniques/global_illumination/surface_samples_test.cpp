// SPDX-License-Identifier: BSD-3-Clause
// Points of surfaces that bear parts of their areas.
#include "renderer/techniques/global_illumination/voxel_propagation/surface_samples.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::techniques {
namespace {

struct Moments {
  double area = 0.0;
  glm::dvec3 mean{0.0};
  double along = 0.0;  ///< variance along a direction
  size_t count = 0;
};

Moments momentsOf(const scene::Mesh& mesh, uint32_t triangle, const std::vector<SurfaceSample>& samples,
                  glm::dvec3 direction) {
  Moments out;
  double square = 0.0;
  const glm::uvec3 corners = mesh.triangles[triangle];
  for (const SurfaceSample& sample : samples) {
    if (sample.triangle != triangle) continue;
    EXPECT_GE(sample.u, -1e-6F);
    EXPECT_GE(sample.v, -1e-6F);
    EXPECT_LE(sample.u + sample.v, 1.0F + 1e-6F);
    EXPECT_GT(sample.area, 0.0);
    const double u = double(sample.u), v = double(sample.v);
    const glm::dvec3 point = (1.0 - u - v) * mesh.positions[corners.x] + u * mesh.positions[corners.y] +
                             v * mesh.positions[corners.z];
    ++out.count;
    out.area += sample.area;
    out.mean += sample.area * point;
    square += sample.area * std::pow(glm::dot(point, direction), 2.0);
  }
  out.mean /= out.area;
  out.along = square / out.area - std::pow(glm::dot(out.mean, direction), 2.0);
  return out;
}

/// A triangle's area, its centre, and its variance along any direction, (a^2 + b^2 + c^2 - 3 m^2) / 12 of its
/// corners' places a, b, c and their mean m, are those of its samples. Each sample stands for a part not
/// longer than two spacings, as rows get narrower, which itself has a variance of up to (2 s)^2 / 12. Slender
/// triangles, as of fans and of narrow strips, whose samples must reach into their tips, and stout ones.
TEST(SurfaceSamples, HaveTheAreaTheCentreAndTheSpreadOfTheirTriangle) {
  const double spacing = 0.25;
  for (const double height : {0.01, 0.2, 3.0, 9.0})
    for (const double apex : {0.0, 0.3, 0.97}) {
      scene::Mesh mesh;
      mesh.positions = {{1.0, 2.0, 3.0}, {11.0, 2.0, 3.0}, {1.0 + 10.0 * apex, 2.0 + height, 3.0}};
      mesh.triangles = {{0, 1, 2}, {2, 0, 1}, {1, 2, 0}};
      scene::Scene scene;
      scene::addPart(scene, "triangle", mesh, glm::vec3(0.5F));
      const std::vector<SurfaceSample> samples = sampleSurfaces(scene, spacing, 1U << 20U);
      const double centre = (mesh.positions[0].x + mesh.positions[1].x + mesh.positions[2].x) / 3.0;
      double variance = 0.0;
      for (const glm::dvec3& corner : mesh.positions) variance += std::pow(corner.x - centre, 2.0) / 12.0;
      for (uint32_t t = 0; t < 3; ++t) {
        const Moments found = momentsOf(scene.mesh, t, samples, {1.0, 0.0, 0.0});
        EXPECT_NEAR(found.area, 5.0 * height, 1e-9 * height);
        // Weights are floats.
        EXPECT_NEAR(found.mean.x, centre, 1e-5);
        EXPECT_NEAR(found.mean.y, 2.0 + height / 3.0, 1e-5);
        EXPECT_LE(found.along, variance + 1e-4);
        EXPECT_GE(found.along, variance - 4.0 * spacing * spacing / 12.0) << height << ", " << apex;
      }
    }
}

/// Two triangles of a long strip have no more samples than the strip has parts of the spacing, one and a half
/// times; in turn, no triangle is without.
TEST(SurfaceSamples, AreFewOnSlenderTriangles) {
  scene::Scene scene;
  scene::addPart(scene, "strip", scene::card(glm::dvec3(0.0), {5.0, 0.0, 0.0}, {0.0, 0.0, 0.01}),
                 glm::vec3(0.5F));
  scene::addPart(scene, "fine", scene::planeGrid({0.0, 1.0, 0.0}, 1.0, 1.0, 32), glm::vec3(0.5F));
  const std::vector<SurfaceSample> samples = sampleSurfaces(scene, 0.25, 1U << 20U);
  size_t strip = 0;
  for (const SurfaceSample& sample : samples) strip += sample.triangle < 2;
  EXPECT_GE(strip, 40U);
  EXPECT_LE(strip, 60U);
  EXPECT_EQ(samples.size() - strip, scene.mesh.triangles.size() - 2);
}

}  // namespace
}  // namespace limen::techniques
