// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/surface_errors.h"

#include <gtest/gtest.h>

#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/pn_set.h"

namespace limen::surfaces {
namespace {

/// Two squares side by side with heights z = bend (x - 1)^2 along x, u of the second running the other way.
PatchSet twoSquares(double bend) {
  PatchSet set;
  const auto point = [&](double x, double y, double h) { return weighted({x, y, h}); };
  // z = b x^2 over [0, 1] as a quadratic: heights 0, 0, b.
  set = {};
  const std::array<glm::dvec4, 6> right = {point(1, 0, 0), point(1.5, 0, 0), point(2, 0, bend),
                                           point(1, 1, 0), point(1.5, 1, 0), point(2, 1, bend)};
  // Turned by half a turn.
  const std::array<glm::dvec4, 6> left = {point(1, 1, 0), point(0.5, 1, 0), point(0, 1, bend),
                                          point(1, 0, 0), point(0.5, 0, 0), point(0, 0, bend)};
  addRectangle(set, 2, 1, right);
  addRectangle(set, 2, 1, left);
  findNeighbours(set);
  return set;
}

TessellatedSurface tessellated(const PatchSet& set, const std::vector<Factors>& factors) {
  TessellatedSurface out;
  out.factors = factors;
  for (uint32_t i = 0; i < set.patches.size(); ++i) {
    const PatternPlan plan = patternOf(set.patches[i].domain, factors[i]);
    const auto first = static_cast<uint32_t>(out.positions.size());
    for (int slot = 0; slot < plan.vertices; ++slot) {
      const DomainPoint at = domainPointOf(plan, slot);
      out.parameters.push_back(at);
      out.patches.push_back(i);
      const SurfaceJet jet = evaluate(set, set.patches[i], at, Order::First);
      out.positions.emplace_back(jet.p);
      out.normals.emplace_back(glm::normalize(glm::cross(jet.u, jet.v)));
    }
    for (const glm::uvec3& t : stripTriangles(patternIndices(plan))) out.triangles.push_back(t + first);
  }
  return out;
}

// A parabola's chord over a segment of length h deviates by bend h^2 / 4 in its middle, at equal parameters.
TEST(SurfaceErrors, AParabolaDeviatesByAQuarterOfItsSegmentsSquare) {
  const PatchSet set = twoSquares(0.5);
  TessellatedSurface surface = tessellated(set, {{4, 1, 4, 1}, {4, 1, 4, 1}});
  // Seen from above at distance 10, a unit being 100 px at distance 1.
  surface.view = {{1, 0.5, 10}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, glm::dvec2(1.0), 100.0, 0.1};
  const Deviation found = deviationOf(set, surface);
  EXPECT_NEAR(found.atParameters.most, 0.5 / 16 / 4, 1e-7);
  EXPECT_EQ(found.samplesInView, found.samples);
  EXPECT_NEAR(found.atParametersPx.most, 100.0 * 0.5 / 16 / 4 / 10, 100.0 * 0.5 / 16 / 4 / 10 * 0.06);
  // At the far end the surface's slope is 1: the closest point is nearer by up to sqrt 2, and never farther.
  EXPECT_LE(found.closest.most, found.atParameters.most);
  EXPECT_GE(found.closest.most, found.atParameters.most / std::sqrt(2.0) - 1e-7);
  EXPECT_LE(found.atParameters.p99, found.atParameters.most);
  EXPECT_LT(normalErrors(set, surface).most, 1e-4);
}

TEST(SurfaceErrors, DeviationTakesTrianglesAtIntervalsWhereSamplesAreLimited) {
  const PatchSet set = twoSquares(0.5);
  const TessellatedSurface surface = tessellated(set, {{64, 9, 64, 9}, {64, 9, 64, 9}});
  EXPECT_LE(deviationOf(set, surface, {8, 10000}).samples, 10000);
  EXPECT_GT(deviationOf(set, surface, {8, 10000}).samples, 9000);
}

TEST(SurfaceErrors, NormalsAreComparedAsAngles) {
  const PatchSet set = twoSquares(0.0);
  TessellatedSurface surface = tessellated(set, {{2, 2, 2, 2}, {2, 2, 2, 2}});
  surface.normals[3] = {std::sin(0.02F), 0.0F, std::cos(0.02F)};
  EXPECT_NEAR(normalErrors(set, surface).most, glm::degrees(0.02), 1e-4);
}

// An octahedron's flat faces with normals from its centre: at a corner, the angle of (1, 0, 0) and (1, 1, 1).
TEST(SurfaceErrors, NormalFieldsAreComparedWithTheGeometry) {
  BaseMesh mesh;
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  mesh.cornerNormals = {{mesh.positions[0], mesh.positions[1], mesh.positions[2]}};
  const PatchSet set = phongSet(mesh, 0.0);
  TessellatedSurface surface = tessellated(set, {{4, 4, 4, 4}});
  for (size_t i = 0; i < surface.normals.size(); ++i)
    surface.normals[i] =
        glm::normalize(surface.positions[i]);  // as the field's: of a sphere about the centre
  EXPECT_LT(normalErrors(set, surface).most, 1e-4);
  const Spread bent = normalErrors(set, surface, NormalsOf::Geometry);
  EXPECT_NEAR(bent.most, glm::degrees(std::acos(1.0 / std::sqrt(3.0))), 1e-4);
  EXPECT_LT(bent.mean, bent.most);
}

TEST(SurfaceErrors, CommonSidesOfEqualFactorsHaveNoCracks) {
  const PatchSet set = twoSquares(0.5);
  // Their common side is side 3 of both.
  const Cracks found = cracksOf(set, tessellated(set, {{4, 7, 2, 5}, {1, 3, 9, 5}}));
  EXPECT_EQ(found.sides, 1);
  EXPECT_EQ(found.unequalVertices, 0);
  EXPECT_EQ(found.loneVertices, 0);
  EXPECT_EQ(found.openEdges, 0);
  EXPECT_EQ(found.foldOvers, 0);
  EXPECT_EQ(found.openSides, 6);
}

TEST(SurfaceErrors, EachKindOfCrackIsFound) {
  const PatchSet set = twoSquares(0.5);
  // 3 and 5 segments share the two ends alone.
  EXPECT_EQ(cracksOf(set, tessellated(set, {{4, 7, 2, 5}, {1, 3, 9, 3}})).loneVertices, 2 + 4);

  TessellatedSurface moved = tessellated(set, {{2, 2, 2, 2}, {2, 2, 2, 2}});
  for (size_t i = 0; i < moved.positions.size(); ++i)
    if (moved.patches[i] == 0 && moved.parameters[i].u == 0.0 && moved.parameters[i].v == 0.5)
      moved.positions[i].z = std::nextafter(moved.positions[i].z, 1.0F);
  EXPECT_EQ(cracksOf(set, moved).unequalVertices, 1);

  TessellatedSurface torn = tessellated(set, {{2, 2, 2, 2}, {2, 2, 2, 2}});
  torn.triangles.erase(torn.triangles.begin() + 1);
  EXPECT_GE(cracksOf(set, torn).openEdges, 2);

  TessellatedSurface folded = tessellated(set, {{2, 2, 2, 2}, {2, 2, 2, 2}});
  std::swap(folded.triangles[0].x, folded.triangles[0].y);
  EXPECT_EQ(cracksOf(set, folded).foldOvers, 1);
}

TEST(SurfaceErrors, CulledPatchesAreNotCompared) {
  const PatchSet set = twoSquares(0.5);
  TessellatedSurface surface = tessellated(set, {{2, 2, 2, 2}, {2, 2, 2, 2}});
  surface.positions.resize(9), surface.patches.resize(9), surface.parameters.resize(9),
      surface.normals.resize(9);
  surface.triangles.resize(8);
  EXPECT_EQ(cracksOf(set, surface).sides, 0);
  EXPECT_EQ(cracksOf(set, surface).loneVertices, 0);
}

}  // namespace
}  // namespace limen::surfaces
