// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/star_surface.h"

#include <gtest/gtest.h>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/techniques/reflections/vertex_reflection/star_map.h"
#include "renderer/techniques/reflections/vertex_reflection/star_mesh.h"

namespace limen::reflections {
namespace {

glm::dvec3 placed(const StarSurface& surface, glm::dvec3 direction) {
  const glm::dvec3 u = glm::normalize(direction);
  return surface(u).radius * u;
}

/// The gradient gives the normal that differences of points give.
TEST(StarSurfaces, NormalsAreThoseOfTheSurface) {
  scene::Random random(5);
  for (const StarSurface& surface :
       {sphereSurface(0.5), ellipsoidSurface({1.0, 1.5, 0.7}), bumpySurface(0.8, 0.1, 7.0)})
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 u = random.direction(), x = scene::perpendicular(u), y = glm::cross(u, x);
      constexpr double kStep = 1e-5;
      const glm::dvec3 alongX = placed(surface, u + kStep * x) - placed(surface, u - kStep * x);
      const glm::dvec3 alongY = placed(surface, u + kStep * y) - placed(surface, u - kStep * y);
      const glm::dvec3 expected = glm::normalize(glm::cross(alongX, alongY));
      EXPECT_GT(glm::dot(outwardNormal(u, surface(u)), expected), 1.0 - 1e-8);
      EXPECT_NEAR(glm::dot(surface(u).gradient, u), 0.0, 1e-12);
    }
}

scene::Mesh ellipsoidMesh(int cells, glm::dvec3 axes, glm::dvec3 centre) {
  scene::Mesh mesh = scene::sphere(glm::dvec3(0.0), 1.0, cells);
  mesh.normals.clear();
  for (glm::dvec3& p : mesh.positions) {
    mesh.normals.emplace_back(glm::normalize(p / axes));
    p = centre + axes * p;
  }
  return mesh;
}

/// Facets of an ellipsoid lie below it by at most a sagitta: half an edge squared over twice the least radius
/// of curvature; interpolated normals are off by as much over the edge.
TEST(StarMeshes, AreTheSurfaceThatTheyTriangulate) {
  const glm::dvec3 axes(1.0, 1.5, 0.7), centre(10.0, -3.0, 2.0);
  const scene::Mesh mesh = ellipsoidMesh(32, axes, centre);
  const auto all = scene::TriangleRange{0, static_cast<uint32_t>(mesh.triangles.size())};
  const StarCentre found = findStarCentre(mesh, all);
  EXPECT_FALSE(found.inside);
  EXPECT_GT(found.leastCosine, 0.5);
  const StarMesh star(mesh, all, centre);
  const StarSurface exact = ellipsoidSurface(axes);
  scene::Random random(9);
  const double edge = 1.5 * 1.5708 / 32.0 * 1.5;  // longest axis, octahedron pushed out
  const double curvature = 1.5 / (0.7 * 0.7);
  const double sagitta = edge * edge * curvature / 8.0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 u = random.direction();
    const RadialPoint at = star.at(u), truth = exact(u);
    ASSERT_GT(at.radius, 0.0);
    EXPECT_LT(at.radius, truth.radius + 1e-9);
    EXPECT_GT(at.radius, truth.radius - 1.5 * sagitta);
    EXPECT_GT(glm::dot(outwardNormal(u, at), outwardNormal(u, truth)), std::cos(edge * curvature / 4.0));
  }
}

TEST(StarMeshes, WhatNoPointSeesIsRecognised) {
  scene::Mesh two = scene::sphere({0.0, 0.0, 0.0}, 0.5, 8);
  scene::append(two, scene::sphere({3.0, 0.0, 0.0}, 0.5, 8));
  EXPECT_LT(findStarCentre(two, {0, static_cast<uint32_t>(two.triangles.size())}).leastCosine, 0.0);
}

/// Texels of both layouts lie where OpenGL looks them up: the middle texel of an odd face is the axis, and
/// a direction's texel is the one whose direction is nearest.
TEST(StarMaps, TexelsCoverAllDirectionsOnce) {
  constexpr int kSide = 16;
  for (int face = 0; face < 6; ++face) {
    const glm::dvec3 axis = texelDirection(MapLayout::Cube, 1, face, 0, 0);
    EXPECT_EQ(axis[face / 2], face % 2 == 0 ? 1.0 : -1.0);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const CubePlace place = cubePlace(texelDirection(MapLayout::Cube, kSide, face, x, y));
        EXPECT_EQ(place.face, face);
        EXPECT_NEAR(0.5 * (place.s + 1.0) * kSide, x + 0.5, 1e-9);
        EXPECT_NEAR(0.5 * (place.t + 1.0) * kSide, y + 0.5, 1e-9);
      }
  }
  const glm::dvec3 first = texelDirection(MapLayout::LatLong, 64, 0, 0, 0);
  EXPECT_GT(first.z, 0.99);
  const glm::dvec3 quarter = texelDirection(MapLayout::LatLong, 64, 0, 16, 32);
  EXPECT_GT(quarter.y, 0.99);
}

TEST(StarMaps, OpenSurfacesAreContinued) {
  // Of half a sphere, only the lower half is there.
  const StarSurface half = [](glm::dvec3 u) {
    return u.y < 0.0 ? RadialPoint{2.0, glm::dvec3(0.0)} : RadialPoint{};
  };
  for (const MapLayout layout : {MapLayout::Cube, MapLayout::LatLong}) {
    const StarMap map = bakeStarMap(half, layout, 8, 2.0);
    EXPECT_NEAR(map.filledShare, 0.5, 0.01);
    for (const RadialPoint& texel : map.texels) EXPECT_NEAR(texel.radius, 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace limen::reflections
