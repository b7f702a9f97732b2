// SPDX-License-Identifier: BSD-3-Clause
// What the GPU makes of tables, against recursive subdivision on the CPU.
#include <algorithm>
#include <cstring>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/subdivision_cages.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/techniques/subdivision/adaptive_mesh.h"
#include "tests/renderer/subdivision/evaluator_fixture.h"

namespace limen::techniques {
namespace {

TEST_F(TablesOnGpu, TheFigureIsTheSizeOfTheBigGuy) {
  const PolygonMesh cage = figureCage();
  EXPECT_EQ(cage.points.size(), 1450U);
  EXPECT_EQ(cage.faces.size(), 2896U);
  EXPECT_FALSE(surfaces::findFault(cage.points.size(), cage.faces).has_value());
  std::vector<int> valence(cage.points.size());
  for (const auto& face : cage.faces)
    for (const uint32_t v : face) ++valence[v];
  EXPECT_EQ(*std::min_element(valence.begin(), valence.end()), 3);
  EXPECT_EQ(*std::max_element(valence.begin(), valence.end()), 7);
  EXPECT_EQ(scene::figureOfQuads().cage.faces.size(), 1448U);
}

/// HOL-04, HOL-05: sums of floats, of at most 19 terms: 19 roundings of 6e-8 of extents below 3 for
/// positions; normals from cross products of such positions, where fans are no smaller than a tenth.
TEST_F(TablesOnGpu, FirstStepEqualsTheCpu) {
  for (const PolygonMesh& mesh :
       {surfaces::bipyramid(7), surfaces::boundaryFan(5), surfaces::openSheet(3, true)}) {
    const Made found = made(mesh, 2);
    const PolygonMesh first = surfaces::loop(mesh);
    std::vector<glm::dvec3> normals(first.points.size(), glm::dvec3(0.0));
    for (const std::vector<uint32_t>& f : first.faces) {
      const glm::dvec3 &a = first.points[f[0]], &b = first.points[f[1]], &c = first.points[f[2]];
      for (const uint32_t v : f) normals[v] += glm::cross(b - a, c - a);
    }
    ASSERT_EQ(found.controls.size(), first.points.size());
    for (size_t v = 0; v < first.points.size(); ++v) {
      EXPECT_LT(glm::length(glm::dvec3(found.controls[v].position) - first.points[v]), 5e-6);
      EXPECT_LT(glm::length(glm::dvec3(found.controls[v].normal) - glm::normalize(normals[v])), 1e-4);
    }
  }
}

/// HOL-08. Weights of 24 slots in single precision: 24 roundings of 6e-8, of extents up to 5.
TEST_F(TablesOnGpu, VerticesAreLimitPointsAtEveryLevel) {
  for (int level = 1; level <= 5; ++level)
    for (const PolygonMesh& mesh : {surfaces::bipyramid(3), surfaces::bipyramid(18), surfaces::boundaryFan(4),
                                    surfaces::boundaryFan(1), surfaces::openSheet(3, true)}) {
      EXPECT_LT(errorsOf(made(mesh, level), mesh).position, 1e-5) << level;
    }
  EXPECT_LT(errorsOf(made(figureCage(), 3), figureCage()).position, 1e-5);
}

/// What flat triangles between limit points leave out: the distance of their edges' middles from the limit
/// points there. It falls at every level: to a quarter where the surface is smooth, and next to extraordinary
/// vertices by the ratio of the eigenvalue that bends it, which is below the subdominant one: 0.63 at most,
/// the limit of high valences.
TEST_F(TablesOnGpu, ErrorOfTrianglesFallsWithEveryLevel) {
  for (const PolygonMesh& mesh :
       {surfaces::bipyramid(3), surfaces::bipyramid(7), surfaces::openSheet(3, true)}) {
    double before = 1e9;
    for (int level = 1; level <= 5; ++level) {
      const Made found = made(mesh, level);
      const PolygonMesh first = surfaces::loop(mesh), fine = surfaces::loop(mesh, level + 1);
      const surfaces::LoopLimit limit = surfaces::loopLimit(fine);
      std::map<std::array<uint32_t, 3>, uint32_t> faces;
      for (uint32_t f = 0; f < first.faces.size(); ++f)
        for (size_t r = 0; r < 3; ++r)
          faces[{first.faces[f][r], first.faces[f][(r + 1) % 3], first.faces[f][(r + 2) % 3]}] =
              3 * f + uint32_t(r);
      const auto triangles = trianglesOf(found.segments);
      double error = 0.0;
      size_t index = 0;
      for (const surfaces::TablePatch& patch : found.layout.patches) {
        const auto vertex = [&](size_t c) { return found.layout.controls[patch.controls[c]].vertex; };
        const uint32_t face = faces.at({vertex(0), vertex(1), vertex(2)});
        for (const auto& triangle : triangles) {
          for (size_t c = 0; c < 3; ++c) {
            const surfaces::Place &a = triangle[c], &b = triangle[(c + 1) % 3];
            std::array<int, 3> weights{};
            weights[(face + 1) % 3] = a[0] + b[0], weights[(face + 2) % 3] = a[1] + b[1];
            weights[face % 3] = 2 * found.segments - a[0] - b[0] - a[1] - b[1];
            const auto [fineFace, corner] = fineCorner(face / 3, weights, 2 * found.segments);
            const glm::dvec3 middle =
                0.5 * (glm::dvec3(found.vertices[found.indices[index + c]].position) +
                       glm::dvec3(found.vertices[found.indices[index + (c + 1) % 3]].position));
            error = std::max(error, glm::length(middle - limit.points[fine.faces[fineFace][corner]]));
          }
          index += 3;
        }
      }
      EXPECT_LT(error, 0.65 * before) << level;
      before = error;
    }
  }
}

/// HOL-10. Normals from tables of tangents are those of the limit: 1e-3 rad, as tangents lose digits at
/// valence
/// 18. The others are what they are: they start from triangles, and the finer these, the nearer.
TEST_F(TablesOnGpu, NormalsByTheirStart) {
  const PolygonMesh mesh = surfaces::triangulated(scene::doubleTorusCage());
  const auto error = [&](NormalStart start) {
    return errorsOf(made(mesh, 4, SubdivisionScheme::Loop, start), mesh).normal;
  };
  const double cage = error(NormalStart::Cage), first = error(NormalStart::First),
               second = error(NormalStart::Second), geometry = error(NormalStart::Geometry);
  EXPECT_LT(geometry, 1e-3);
  EXPECT_LT(second, first);
  EXPECT_LT(first, cage);
  EXPECT_GT(second, 0.01);
  std::printf("largest angle [deg]: cage %.2f, first %.2f, second %.2f, geometry %.4f\n", cage * 180 / M_PI,
              first * 180 / M_PI, second * 180 / M_PI, geometry * 180 / M_PI);
  EXPECT_LT(errorsOf(made(surfaces::boundaryFan(4), 4, SubdivisionScheme::Loop, NormalStart::Geometry),
                     surfaces::boundaryFan(4))
                .normal,
            1e-3);
}

/// HOL-06: every edge of a closed mesh has two triangles, in opposite directions, and the surface is a
/// sphere's or a double torus's by its Euler characteristic.
TEST_F(TablesOnGpu, ClosedMeshesHaveNoOpenEdges) {
  const auto characteristic = [&](const Made& found) {
    std::set<std::array<uint32_t, 2>> directed;
    std::set<uint32_t> used(found.indices.begin(), found.indices.end());
    for (size_t i = 0; i < found.indices.size(); i += 3)
      for (size_t c = 0; c < 3; ++c) {
        const bool added = directed.insert({found.indices[i + c], found.indices[i + (c + 1) % 3]}).second;
        EXPECT_TRUE(added);
      }
    for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a}));
    EXPECT_EQ(used.size(), found.vertices.size());
    return int64_t(used.size()) - int64_t(directed.size() / 2) + int64_t(found.indices.size() / 3);
  };
  EXPECT_EQ(characteristic(made(surfaces::bipyramid(5), 4)), 2);
  EXPECT_EQ(characteristic(made(surfaces::triangulated(scene::doubleTorusCage()), 3)), -2);
  EXPECT_EQ(characteristic(made(scene::doubleTorusCage(), 3, SubdivisionScheme::CatmullClark)), -2);
  EXPECT_EQ(characteristic(made(surfaces::bipyramid(8), 3, SubdivisionScheme::Butterfly)), 2);
}

/// Both sides of a crease have vertices of their own, with normals of their own, at the same places bit by
/// bit.
TEST_F(TablesOnGpu, CreasesHaveTwoNormalsAndOnePosition) {
  PolygonMesh mesh = surfaces::bipyramid(6);
  for (uint32_t i = 0; i < 6; ++i)
    mesh.sharpness[surfaces::edgeKey(2 + i, 2 + (i + 1) % 6)] = surfaces::kInfinitelySharp;
  const Made found = made(mesh, 4);
  std::map<std::array<float, 3>, std::vector<glm::vec3>> normals;
  for (const TessellatedVertex& v : found.vertices)
    normals[{v.position.x, v.position.y, v.position.z}].push_back(v.normal);
  size_t split = 0;
  for (const auto& [at, of] : normals) {
    ASSERT_LE(of.size(), 2U);
    if (of.size() < 2) continue;
    ++split;
    EXPECT_LT(glm::dot(of[0], of[1]), 0.9F);
  }
  EXPECT_EQ(split, 6U * 16U);  // 16 segments along each edge of the control mesh
  EXPECT_LT(errorsOf(found, mesh).position, 1e-5);
}

/// HOL-13: joints move the control mesh, and nothing else is made anew.
TEST_F(TablesOnGpu, ThePoseIsThatOfTheJoints) {
  const surfaces::SubdivisionSurface figure = scene::figureOfTriangles();
  PolygonMesh posed = figure.cage;
  posed.points = surfaces::skinned(figure, 0.3);
  double moved = 0.0;
  for (size_t v = 0; v < posed.points.size(); ++v)
    moved = std::max(moved, glm::length(posed.points[v] - figure.cage.points[v]));
  EXPECT_GT(moved, 0.1);
  EXPECT_LT(errorsOf(made(figure, {2, NormalStart::First}, 0.3), posed).position, 1e-5);
}

/// An affine map of the control mesh is one of the surface: a property of all schemes, and the Butterfly
/// scheme keeps the control mesh's vertices and, on a regular grid, cubic functions (Dyn et al. 1990).
TEST_F(TablesOnGpu, ButterflyKeepsVerticesAndCubics) {
  const PolygonMesh mesh = surfaces::bipyramid(7);
  const Made found = made(mesh, 4, SubdivisionScheme::Butterfly);
  for (const glm::dvec3& p : mesh.points)
    EXPECT_TRUE(std::any_of(found.vertices.begin(), found.vertices.end(), [&](const TessellatedVertex& v) {
      return glm::length(glm::dvec3(v.position) - p) < 1e-6;
    }));
  // A torus of regular triangles, whose heights are a cubic on part of it.
  constexpr uint32_t kSide = 12;
  PolygonMesh torus;
  const auto height = [](double x, double y) { return 0.02 * x * x * x - 0.03 * x * y * y + 0.05 * y * x; };
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) torus.points.emplace_back(x, y, height(x - 6.0, y - 6.0));
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t right = (x + 1) % kSide, up = (y + 1) % kSide;
      const uint32_t a = x + kSide * y, b = right + kSide * y, c = right + kSide * up, d = x + kSide * up;
      torus.faces.insert(torus.faces.end(), {{a, b, c}, {a, c, d}});
    }
  const Made regular = made(torus, 4, SubdivisionScheme::Butterfly);
  const size_t each = 3 * size_t(regular.segments) * size_t(regular.segments);
  int inside = 0;
  for (size_t p = 0; p < regular.layout.patches.size(); ++p) {
    const uint32_t square = regular.layout.patches[p].parent / 2;
    const int x = int(square % kSide) - 6, y = int(square / kSide) - 6;
    if (x < -2 || x > 1 || y < -2 || y > 1) continue;  // three squares away from where the cubic ends
    for (size_t i = 0; i < each; ++i) {
      const glm::dvec3 at(regular.vertices[regular.indices[each * p + i]].position);
      ++inside;
      // Heights of up to 10 in floats.
      EXPECT_NEAR(at.z, height(at.x - 6.0, at.y - 6.0), 1e-5);
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST_F(TablesOnGpu, WhatDoesNotFitIsRefusedInWords) {
  EXPECT_THROW(made(surfaces::bipyramid(70), 2), Error);
  EXPECT_THROW(made(surfaces::bipyramid(5), 1, SubdivisionScheme::Loop, NormalStart::Second), Error);
  EXPECT_THROW(made(surfaces::bipyramid(5), 2, SubdivisionScheme::CatmullClark, NormalStart::Geometry),
               Error);
}

}  // namespace
}  // namespace limen::techniques
