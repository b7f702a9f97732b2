// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/embree_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::references {
namespace {

/// A cube turned about a skew axis, so that no coordinate is a round number.
scene::Scene turnedCube(double size) {
  scene::Mesh cube = scene::box(glm::dvec3(-0.5), glm::dvec3(0.5));
  const glm::dvec3 z = glm::normalize(glm::dvec3(0.3, -0.5, 0.8)),
                   x = glm::normalize(glm::cross(z, {0.1, 1.0, 0.2}));
  for (glm::dvec3& position : cube.positions)
    position = size * (glm::dmat3(x, glm::cross(z, x), z) * position);
  scene::Scene scene;
  scene::addPart(scene, "cube", cube, glm::vec3(0.7F));
  return scene;
}

/// Calls check(point, out, distance) for points on every triangle at many distances (in edge lengths) from
/// each edge; `out` points over that edge, along the triangle.
template <class Check>
void nearEdges(const Triangles& triangles, const Check& check) {
  scene::Random random(3);
  for (uint32_t i = 0; i < triangles.count(); ++i)
    for (int edge = 0; edge < 3; ++edge)
      for (int n = 0; n < 400; ++n) {
        const glm::dvec3 a = triangles.corner(i, edge), b = triangles.corner(i, (edge + 1) % 3),
                         c = triangles.corner(i, (edge + 2) % 3);
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a)),
                         out = glm::normalize(glm::cross(b - a, normal));
        const double distance = std::pow(10.0, random.uniform(-9.0, -3.0)), along = random.uniform(0.2, 0.8);
        check(ReceiverPoint{0, i, a + (b - a) * along - out * distance * glm::length(b - a), normal}, out,
              distance);
      }
}

TEST(EmbreeScene, NoPointOfAConvexBodyHidesTheLightFromItselfHoweverGrazing) {
  for (const double size : {1.0, 1e-4, 1e4}) {
    const scene::Scene scene = turnedCube(size);
    const Triangles triangles(scene, glm::dvec3(0.0));
    const EmbreeScene tracer(triangles);
    scene::Random random(5);
    size_t occluded = 0;
    nearEdges(triangles, [&](const ReceiverPoint& point, glm::dvec3 out, double) {
      // Rounded vertices bend a face by some 1e-7 at most.
      const double elevation = std::pow(10.0, random.uniform(-4.0, -0.5));
      occluded += tracer.occluded(point, point.position + 3.0 * size * (out + elevation * point.normal));
    });
    EXPECT_EQ(occluded, 0U) << size;
  }
}

TEST(EmbreeScene, ABodyHidesWhatLiesBelowItsHorizonEvenAtAnEdge) {
  const scene::Scene scene = turnedCube(1.0);
  const Triangles triangles(scene, glm::dvec3(0.0));
  const EmbreeScene tracer(triangles);
  size_t asked = 0, seen = 0;
  nearEdges(triangles, [&](const ReceiverPoint& point, glm::dvec3 out, double distance) {
    if (distance < 1e-5) return;  // a few plane tolerances: the other face's plane holds the point
    ++asked;
    seen += !tracer.occluded(point, point.position + 3.0 * (out - 0.3 * point.normal));
  });
  EXPECT_GT(asked, 1000U);
  EXPECT_EQ(seen, 0U);
}

TEST(EmbreeScene, WhatLiesInTheLightsPlaneHidesNothing) {
  scene::Scene scene;
  scene::addPart(scene, "floor", scene::card({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}),
                 glm::vec3(0.7F));
  scene::addPart(scene, "card", scene::card({0.0, 2.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}),
                 glm::vec3(0.7F));
  const Triangles triangles(scene, glm::dvec3(0.0));
  const EmbreeScene tracer(triangles);
  const ReceiverPoint floor{0, 0, {0.1, 0.0, 0.2}, {0.0, 1.0, 0.0}};
  EXPECT_FALSE(tracer.occluded(floor, {0.2, 2.0, 0.1}));
  EXPECT_TRUE(tracer.occluded(floor, {0.2, 2.001, 0.1}));
}

TEST(EmbreeScene, ASceneWithoutTrianglesHidesNothing) {
  const Triangles triangles(scene::Scene{}, glm::dvec3(0.0));
  EXPECT_FALSE(EmbreeScene(triangles).occluded(ReceiverPoint{0, 0, glm::dvec3(0.0), {0.0, 1.0, 0.0}},
                                               {0.0, 1.0, 0.0}));
}

}  // namespace
}  // namespace limen::references
