// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/other_patterns.h"

#include <gtest/gtest.h>

#include <map>

namespace limen::surfaces {
namespace {

/// Triangles turn counter-clockwise, their areas sum to the domain's, and inner edges have two triangles.
void expectTiling(Domain domain, const PatternMesh& mesh, const std::string& what) {
  double area = 0.0;
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec2 a = mesh.points[t.x], b = mesh.points[t.y], c = mesh.points[t.z];
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    EXPECT_GT(twice, 1e-12) << what;
    area += 0.5 * twice;
    for (int k = 0; k < 3; ++k) EXPECT_EQ((++edges[{t[k], t[(k + 1) % 3]}]), 1) << what;
  }
  EXPECT_NEAR(area, domain == Domain::Rectangle ? 1.0 : 0.5, 1e-9) << what;
  // Euler: a disc with one boundary of as many edges as have no opposite.
  int64_t open = 0;
  for (const auto& [edge, count] : edges) open += edges.count({edge.second, edge.first}) == 0;
  const auto triangles = static_cast<int64_t>(mesh.triangles.size());
  EXPECT_EQ(static_cast<int64_t>(mesh.points.size()) - (3 * triangles + open) / 2 + triangles, 1) << what;
}

std::string named(const Factors& f) {
  return std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + " " +
         std::to_string(f[3]);
}

TEST(OtherPatterns, TileTheDomain) {
  for (int code = 0; code < 6 * 6 * 6 * 6; ++code) {
    const Factors f = {code % 6 + 1, code / 6 % 6 + 1, code / 36 % 6 + 1, code / 216 + 1};
    if (f[3] == 1)
      for (int inner = 1; inner <= 6; ++inner)
        expectTiling(Domain::Triangle, concentricPattern(Domain::Triangle, f, {inner, inner}),
                     "triangle " + named(f));
    expectTiling(Domain::Rectangle,
                 concentricPattern(Domain::Rectangle, f, {std::min(f[0], f[2]), std::min(f[1], f[3])}),
                 "quad " + named(f));
    // A transition on one segment alone leaves Moreton's no core.
    if (std::max(f[0], f[2]) > 1 && std::max(f[1], f[3]) > 1)
      expectTiling(Domain::Rectangle, moretonPattern(f), "Moreton " + named(f));
  }
}

/// Uniform factors: m^2 / 2 + 3 m / 2 + 1 points of ours, floor(m^2 / 4) more of concentric ones.
TEST(OtherPatterns, ConcentricTrianglesTakeMorePoints) {
  for (int m = 2; m <= 64; ++m) {
    const Factors f = {m, m, m, m};
    const size_t ours = patternMesh(Domain::Triangle, f).points.size(),
                 theirs = concentricPattern(Domain::Triangle, f, {m, m}).points.size();
    EXPECT_EQ(ours, size_t(m * m + 3 * m + 2) / 2);
    EXPECT_EQ(theirs, ours + size_t(m * m / 4)) << m;
  }
}

/// Over factors to 8: no more triangles than the tessellator makes of the same factors, and fewer than
/// Moreton.
TEST(OtherPatterns, OursHaveNoMoreTriangles) {
  std::array<size_t, 2> ours{}, concentric{};
  size_t moreton = 0;
  std::array<double, 2> angleOurs{}, angleConcentric{};
  double angleMoreton = 0.0;
  std::array<int, 2> count{};
  for (int code = 0; code < 8 * 8 * 8 * 8; code += 3) {
    const Factors f = {code % 8 + 1, code / 8 % 8 + 1, code / 64 % 8 + 1, code / 512 + 1};
    for (const Domain domain : {Domain::Rectangle, Domain::Triangle}) {
      const auto d = static_cast<size_t>(domain);
      if (domain == Domain::Rectangle && (std::min(f[0], f[2]) < 2 || std::min(f[1], f[3]) < 2)) continue;
      const glm::ivec2 inner = domain == Domain::Rectangle
                                   ? glm::ivec2(std::min(f[0], f[2]), std::min(f[1], f[3]))
                                   : glm::ivec2(std::max({f[0], f[1], f[2]}));
      const PatternShape a = shapeOf(domain, patternMesh(domain, f)),
                         b = shapeOf(domain, concentricPattern(domain, f, inner));
      ++count[d];
      ours[d] += a.triangles, concentric[d] += b.triangles;
      angleOurs[d] += a.smallestAngleDeg, angleConcentric[d] += b.smallestAngleDeg;
      if (domain == Domain::Rectangle) {
        const PatternShape c = shapeOf(domain, moretonPattern(f));
        moreton += c.triangles, angleMoreton += c.smallestAngleDeg;
      }
    }
  }
  for (const size_t d : {0U, 1U}) {
    EXPECT_LE(ours[d], concentric[d]) << d;
    std::printf("%s: triangles ours %zu, concentric %zu; mean smallest angle %.2f, %.2f\n",
                d == 0 ? "rectangle" : "triangle", ours[d], concentric[d], angleOurs[d] / count[d],
                angleConcentric[d] / count[d]);
  }
  EXPECT_LT(ours[0], moreton);
  std::printf("Moreton: triangles %zu, mean smallest angle %.2f\n", moreton, angleMoreton / count[0]);
}

}  // namespace
}  // namespace limen::surfaces
