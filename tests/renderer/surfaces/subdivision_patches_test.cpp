// SPDX-License-Identifier: BSD-3-Clause
// Points and patches of subdivision surfaces against repeated subdivision.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/subdivision_cages.h"
#include "renderer/scene/shapes.h"
#include "renderer/surfaces/acc_patches.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/c_patches.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/catmull_clark_point.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/normal.h"
#include "renderer/surfaces/pm_patches.h"
#include "tests/renderer/surfaces/angle.h"

namespace limen::surfaces {
namespace {

/// An open bumpy sheet of 5 x 5 quads with a crease of the given sharpness across it.
PolygonMesh sheet(double sharpness) {
  scene::Random random(12);
  PolygonMesh mesh;
  for (int y = 0; y <= 5; ++y)
    for (int x = 0; x <= 5; ++x) mesh.points.emplace_back(x, y, random.uniform(-0.6, 0.6));
  for (uint32_t y = 0; y < 5; ++y)
    for (uint32_t x = 0; x < 5; ++x)
      mesh.faces.push_back({x + 6 * y, x + 1 + 6 * y, x + 7 + 6 * y, x + 6 + 6 * y});
  if (sharpness > 0.0)
    for (uint32_t y = 0; y < 5; ++y) mesh.sharpness[edgeKey(3 + 6 * y, 3 + 6 * (y + 1))] = sharpness;
  return mesh;
}

/// SC-21: at every vertex of the mesh after four steps, its limit position and normal. Vertex numbers of
/// children are followed through the faces: child i of a face begins at its corner i.
void expectLimits(const PolygonMesh& mesh) {
  const int kSteps = 4;
  const PolygonMesh fine = catmullClark(mesh, kSteps);
  const LimitPoints limit = catmullClarkLimit(fine);
  size_t checked = 0;
  for (uint32_t face = 0; face < mesh.faces.size(); face += 7) {
    for (uint32_t child = 0; child < 256; child += 5) {
      // Corner (0, 0) of the child and its first side, in the face's parameters.
      glm::dvec2 origin(0.0), x(1.0, 0.0), y(0.0, 1.0);
      for (int level = kSteps - 1; level >= 0; --level) {
        const uint32_t corner = (child >> (2 * level)) & 3U;
        const std::array<glm::dvec2, 4> start = {origin, origin + x, origin + x + y, origin + y};
        const std::array<std::array<glm::dvec2, 2>, 4> sides = {{{x, y}, {y, -x}, {-x, -y}, {-y, x}}};
        origin = start[corner];
        x = 0.5 * sides[corner][0], y = 0.5 * sides[corner][1];
      }
      const uint32_t fineFace = 256 * face + child;
      const LimitPoint point = catmullClarkPoint(mesh, face, origin.x, origin.y);
      EXPECT_LT(glm::length(point.position - limit.points[fine.faces[fineFace][0]]), 1e-9)
          << face << ' ' << child << " after " << point.steps;
      ++checked;
    }
  }
  EXPECT_GT(checked, 100U);
}

TEST(CatmullClarkPoint, IsTheLimitOfSubdivision) {
  expectLimits(scene::doubleTorusCage());
  expectLimits(sheet(0.0));
  expectLimits(sheet(kInfinitelySharp));
  expectLimits(sheet(2.5));
}

/// Normals where the surface is smooth, at parameters that subdivision does not reach.
TEST(CatmullClarkPoint, NormalsAreThoseOfDifferences) {
  const PolygonMesh cage = scene::doubleTorusCage();
  scene::Random random(4);
  for (int k = 0; k < 40; ++k) {
    const auto face = uint32_t(random.uniform(0.0, 47.999));
    const double u = random.uniform(0.05, 0.95), v = random.uniform(0.05, 0.95), h = 1e-5;
    const auto at = [&](double du, double dv) {
      return catmullClarkPoint(cage, face, u + du, v + dv).position;
    };
    const glm::dvec3 normal = glm::normalize(glm::cross(at(h, 0) - at(-h, 0), at(0, h) - at(0, -h)));
    EXPECT_LT(glm::length(normal - catmullClarkPoint(cage, face, u, v).normal), 1e-6);
  }
}

/// SC-23: on regular faces the patch is the surface; everywhere its corners are limit points.
TEST(AccPatches, AreExactOnRegularFaces) {
  const PolygonMesh mesh = catmullClark(scene::doubleTorusCage());
  PatchSet set = accPatches(mesh);
  const LimitPoints limit = catmullClarkLimit(mesh);
  const MeshTopology topology(mesh);
  size_t regular = 0;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& face = mesh.faces[f];
    bool isRegular = true;
    for (size_t c = 0; c < 4; ++c) {
      const DomainPoint at = sidePoint(Domain::Rectangle, int(c), 0, 1);
      EXPECT_LT(glm::length(evaluate(set, set.patches[f], at).p - limit.points[face[c]]), 1e-14);
      isRegular &= topology.rings()[face[c]].faces.size() == 4;
    }
    if (!isRegular) continue;
    ++regular;
    for (const double u : {0.1, 0.5, 0.8})
      for (const double v : {0.0, 0.3, 0.9})
        EXPECT_LT(glm::length(evaluate(set, set.patches[f], rectanglePoint(u, v)).p -
                              catmullClarkPoint(mesh, f, u, v).position),
                  1e-13);
  }
  EXPECT_GT(regular, 100U);
  const SideCounts counts = findNeighbours(set);
  EXPECT_EQ(counts.shared, 4U * mesh.faces.size());
}

/// SC-23: the normal field of tangent patches is the surface's on regular faces and at all corners.
TEST(AccPatches, TangentPatchesAreExactOnRegularFaces) {
  const PolygonMesh mesh = catmullClark(scene::doubleTorusCage());
  const PatchSet set = accPatches(mesh, AccNormals::TangentPatches);
  const LimitPoints limit = catmullClarkLimit(mesh);
  const MeshTopology topology(mesh);
  size_t regular = 0;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    bool isRegular = true;
    for (size_t c = 0; c < 4; ++c) {
      const DomainPoint at = sidePoint(Domain::Rectangle, int(c), 0, 1);
      const SurfaceNormal normal = normalAt(set, set.patches[f], at);
      EXPECT_EQ(normal.rung, NormalRung::Field);
      EXPECT_LT(angleDeg(normal.direction, limit.normals[f][c]), 1e-6);
      isRegular &= topology.rings()[mesh.faces[f][c]].faces.size() == 4;
    }
    if (!isRegular) continue;
    ++regular;
    for (const double u : {0.1, 0.5, 0.8})
      for (const double v : {0.0, 0.3, 0.9})
        EXPECT_LT(angleDeg(normalAt(set, set.patches[f], rectanglePoint(u, v)).direction,
                           catmullClarkPoint(mesh, f, u, v).normal),
                  1e-6);
  }
  EXPECT_GT(regular, 100U);
}

/// Around irregular vertices patches meet at angles, and their normal fields do not.
TEST(AccPatches, TangentPatchesAgreeAcrossEdges) {
  for (const int steps : {0, 1}) {
    const PolygonMesh mesh = catmullClark(scene::doubleTorusCage(), steps);
    const PatchSet set = accPatches(mesh, AccNormals::TangentPatches);
    double field = 0.0, geometry = 0.0, fieldError = 0.0, geometryError = 0.0;
    for (size_t p = 0; p < set.patches.size(); ++p) {
      for (int side = 0; side < 4; ++side) {
        const Neighbour& beyond = set.neighbours[p][size_t(side)];
        ASSERT_TRUE(beyond.patch >= 0 && beyond.reversed);
        const Patch& other = set.patches[size_t(beyond.patch)];
        for (int q = 0; q <= 10; ++q) {
          const DomainPoint at = sidePoint(Domain::Rectangle, side, q, 10),
                            there = sidePoint(Domain::Rectangle, beyond.side, 10 - q, 10);
          field = std::max(field, angleDeg(normalAt(set, set.patches[p], at).direction,
                                           normalAt(set, other, there).direction));
          geometry = std::max(geometry, angleDeg(geometricNormal(set, set.patches[p], at).direction,
                                                 geometricNormal(set, other, there).direction));
        }
      }
      for (const double u : {0.05, 0.3, 0.6, 0.95})
        for (const double v : {0.1, 0.5, 0.9}) {
          const glm::dvec3 exact = catmullClarkPoint(mesh, uint32_t(p), u, v).normal;
          const DomainPoint at = rectanglePoint(u, v);
          fieldError += angleDeg(normalAt(set, set.patches[p], at).direction, exact);
          geometryError += angleDeg(geometricNormal(set, set.patches[p], at).direction, exact);
        }
    }
    EXPECT_LT(field, 1e-5) << steps;
    EXPECT_GT(geometry, 1.0) << steps;
    const double points = 12.0 * double(set.patches.size());
    // Continuous, but not closer to the surface's normals than the geometry is: 0.63 and 0.50 degrees on
    // average.
    EXPECT_LT(fieldError / points, 1.0) << steps;
    EXPECT_LT(geometryError / points, 1.0) << steps;
  }
}

/// SC-24: tangent planes agree along all sides, within quads and between them, whatever the valences; corners
/// have the surface's points and normals.
TEST(CPatches, AreSmooth) {
  double deviation[2] = {};
  for (const int steps : {0, 1}) {
    const PolygonMesh mesh = catmullClark(scene::doubleTorusCage(), steps);
    PatchSet set = cPatches(mesh);
    ASSERT_EQ(set.patches.size(), 4 * mesh.faces.size());
    const SideCounts counts = findNeighbours(set);
    EXPECT_EQ(counts.open + counts.crowded + counts.collapsed, 0U);
    const LimitPoints limit = catmullClarkLimit(mesh);
    double angle = 0.0;
    for (size_t p = 0; p < set.patches.size(); ++p) {
      for (int side = 0; side < 3; ++side) {
        const Neighbour& beyond = set.neighbours[p][size_t(side)];
        ASSERT_TRUE(beyond.patch >= 0 && beyond.reversed);
        for (int q = 0; q <= 10; ++q)
          angle = std::max(
              angle,
              angleDeg(
                  geometricNormal(set, set.patches[p], sidePoint(Domain::Triangle, side, q, 10)).direction,
                  geometricNormal(set, set.patches[size_t(beyond.patch)],
                                  sidePoint(Domain::Triangle, beyond.side, 10 - q, 10))
                      .direction));
      }
      const size_t face = p / 4, corner = p % 4;
      const DomainPoint at = trianglePoint(1.0, 0.0);
      EXPECT_LT(glm::length(evaluate(set, set.patches[p], at).p - limit.points[mesh.faces[face][corner]]),
                1e-13);
      EXPECT_LT(angleDeg(geometricNormal(set, set.patches[p], at).direction, limit.normals[face][corner]),
                1e-6);
      // In the first triangle (u, v, w) lies at v (1, 0) + w (1/2, 1/2).
      if (corner > 0) continue;
      for (const double v : {0.1, 0.4, 0.7})
        for (const double w : {0.1, 0.25})
          deviation[steps] =
              std::max(deviation[steps],
                       glm::length(evaluate(set, set.patches[p], trianglePoint(1 - v - w, v)).p -
                                   catmullClarkPoint(mesh, uint32_t(face), v + 0.5 * w, 0.5 * w).position));
    }
    EXPECT_LT(angle, 1e-5) << steps;
  }
  // Of a surface about 6 wide.
  EXPECT_LT(deviation[0], 0.1);
  EXPECT_LT(deviation[1], 0.5 * deviation[0]);
}

/// A flat sheet of even squares stays as it is, parameters too.
TEST(CPatches, OfAFlatSheetAreFlat) {
  PolygonMesh mesh = sheet(0.0);
  for (glm::dvec3& p : mesh.points) p.z = 0.5 * p.x - p.y;
  const PatchSet set = cPatches(mesh);
  // Face 12 lies in the middle: x and y from 2 to 3.
  for (const double v : {0.0, 0.3, 0.6})
    for (const double w : {0.0, 0.2, 0.4}) {
      const glm::dvec3 p = evaluate(set, set.patches[48], trianglePoint(1 - v - w, v)).p;
      const double x = 2.0 + v + 0.5 * w, y = 2.0 + 0.5 * w;
      EXPECT_LT(glm::length(p - glm::dvec3(x, y, 0.5 * x - y)), 1e-13);
    }
}

/// Boundaries are the cubic B-splines of the sheet.
TEST(AccPatches, HaveTheSurfacesBoundary) {
  const PolygonMesh mesh = sheet(0.0);
  const PatchSet set = accPatches(mesh);
  for (uint32_t f = 0; f < 5; ++f)
    for (const double u : {0.0, 0.25, 0.7, 1.0})
      EXPECT_LT(glm::length(evaluate(set, set.patches[f], rectanglePoint(u, 0.0)).p -
                            catmullClarkPoint(mesh, f, u, 0.0).position),
                1e-9);
}

/// SC-23: along creases and boundaries, at whose vertices two faces meet on this side, or one at a corner,
/// the patches and their normal field are the surface.
TEST(AccPatches, AreExactAtCreasesAndBoundaries) {
  const PolygonMesh mesh = sheet(kInfinitelySharp);
  const PatchSet set = accPatches(mesh, AccNormals::TangentPatches);
  for (uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (const double u : {0.02, 0.4, 0.97})
      for (const double v : {0.05, 0.5, 0.9}) {
        const LimitPoint exact = catmullClarkPoint(mesh, f, u, v);
        const DomainPoint at = rectanglePoint(u, v);
        // A few dozen roundings of numbers up to 5.
        EXPECT_LT(glm::length(evaluate(set, set.patches[f], at).p - exact.position), 1e-13) << f;
        EXPECT_LT(angleDeg(normalAt(set, set.patches[f], at).direction, exact.normal), 1e-6) << f;
      }
}

/// Extraordinary vertices on creases, of which one side may be regular and the other not; corners. Sharp
/// edges are the surface's curves; across the others the normal field does not jump, and the geometry does.
TEST(AccPatches, TangentPatchesAgreeAcrossTheSmoothEdgesOfCreasedMeshes) {
  for (const scene::CageShape shape : {scene::CageShape::CreasedBlock, scene::CageShape::CorneredBlock})
    for (const int steps : {0, 1, 2}) {
      const PolygonMesh mesh = catmullClark(scene::closedCage(shape), steps);
      const MeshTopology topology(mesh);
      const PatchSet set = accPatches(mesh, AccNormals::TangentPatches);
      double field = 0.0, curve = 0.0;
      size_t smooth = 0, sharp = 0;
      for (uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (int side = 0; side < 4; ++side) {
          const uint32_t a = mesh.faces[f][size_t(side)], b = mesh.faces[f][size_t(side + 1) % 4];
          const Neighbour& beyond = set.neighbours[f][size_t(side)];
          ASSERT_TRUE(beyond.patch >= 0 && beyond.reversed);
          const bool isSharp = topology.sharpness(mesh, edgeKey(a, b)) >= kInfinitelySharp;
          ++(isSharp ? sharp : smooth);
          for (int q = 1; q < 10; ++q) {
            const DomainPoint at = sidePoint(Domain::Rectangle, side, q, 10),
                              there = sidePoint(Domain::Rectangle, beyond.side, 10 - q, 10);
            if (isSharp)
              curve = std::max(curve, glm::length(evaluate(set, set.patches[f], at).p -
                                                  catmullClarkPoint(mesh, f, at.u, at.v).position));
            else
              field = std::max(field,
                               angleDeg(normalAt(set, set.patches[f], at).direction,
                                        normalAt(set, set.patches[size_t(beyond.patch)], there).direction));
          }
        }
      EXPECT_GT(smooth, 0U);
      EXPECT_GT(sharp, 0U);
      EXPECT_LT(field, 1e-5) << int(shape) << ' ' << steps;
      EXPECT_LT(curve, 1e-9) << int(shape) << ' ' << steps;
    }
}

/// A house with a pentagon for its floor, walls of quads and a roof of triangles; uneven.
PolygonMesh house() {
  scene::Random random(3);
  PolygonMesh mesh;
  for (int level = 0; level < 2; ++level)
    for (int i = 0; i < 5; ++i)
      mesh.points.emplace_back(std::cos(0.4 * M_PI * i) + random.uniform(-0.1, 0.1),
                               std::sin(0.4 * M_PI * i) + random.uniform(-0.1, 0.1),
                               level + random.uniform(-0.1, 0.1));
  mesh.points.emplace_back(0.05, 0.1, 1.7);
  mesh.faces = {{4, 3, 2, 1, 0}};
  for (uint32_t i = 0; i < 5; ++i) {
    const uint32_t j = (i + 1) % 5;
    mesh.faces.push_back({i, j, j + 5, i + 5});
    mesh.faces.push_back({i + 5, j + 5, 10});
  }
  return mesh;
}

/// SC-24: tangent planes agree along all sides of fans over triangles, quads and pentagons, and between them.
TEST(PmPatches, AreSmooth) {
  for (const PolygonMesh& mesh : {house(), scene::doubleTorusCage(), catmullClark(house())}) {
    PatchSet set = pmPatches(mesh);
    size_t sides = 0;
    for (const std::vector<uint32_t>& face : mesh.faces) sides += face.size();
    ASSERT_EQ(set.patches.size(), sides);
    const SideCounts counts = findNeighbours(set);
    EXPECT_EQ(counts.open + counts.crowded + counts.collapsed, 0U);
    double angle = 0.0;
    for (size_t p = 0; p < set.patches.size(); ++p)
      for (int side = 0; side < 3; ++side) {
        const Neighbour& beyond = set.neighbours[p][size_t(side)];
        ASSERT_TRUE(beyond.patch >= 0 && beyond.reversed);
        for (int q = 0; q <= 10; ++q)
          angle = std::max(
              angle,
              angleDeg(
                  geometricNormal(set, set.patches[p], sidePoint(Domain::Triangle, side, q, 10)).direction,
                  geometricNormal(set, set.patches[size_t(beyond.patch)],
                                  sidePoint(Domain::Triangle, beyond.side, 10 - q, 10))
                      .direction));
      }
    EXPECT_LT(angle, 1e-5);
  }
}

/// Over quads the vertices have the surface's points and normals.
TEST(PmPatches, OfQuadsInterpolateTheLimit) {
  const PolygonMesh mesh = catmullClark(house());
  const PatchSet set = pmPatches(mesh);
  const LimitPoints limit = catmullClarkLimit(mesh);
  for (size_t p = 0; p < set.patches.size(); ++p) {
    const DomainPoint at = trianglePoint(1.0, 0.0);
    EXPECT_LT(glm::length(evaluate(set, set.patches[p], at).p - limit.points[mesh.faces[p / 4][p % 4]]),
              1e-13);
    EXPECT_LT(angleDeg(geometricNormal(set, set.patches[p], at).direction, limit.normals[p / 4][p % 4]),
              1e-5);
  }
}

TEST(PmPatches, RefuseOpenMeshesAndHexagons) {
  EXPECT_THROW(pmPatches(sheet(0.0)), std::invalid_argument);
  PolygonMesh prism;
  for (int i = 0; i < 12; ++i)
    prism.points.emplace_back(std::cos(M_PI / 3.0 * i), std::sin(M_PI / 3.0 * i), i / 6);
  prism.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (uint32_t i = 0; i < 6; ++i) prism.faces.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
  EXPECT_THROW(pmPatches(prism), std::invalid_argument);
}

}  // namespace
}  // namespace limen::surfaces
