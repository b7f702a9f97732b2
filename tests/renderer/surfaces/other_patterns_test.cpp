// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/other_patterns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
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

/// Boundary edges of a pattern lie on the sides, as many as each side's factor.
void expectSides(const PatternMesh& mesh, const Factors& factors, const std::string& what) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  std::array<int, 3> found{};
  for (const auto& [edge, count] : edges) {
    if (edges.contains({edge.second, edge.first})) continue;
    const glm::dvec2 a = mesh.points[edge.first], b = mesh.points[edge.second];
    const std::array<double, 3> away = {std::max(1.0 - a.x - a.y, 1.0 - b.x - b.y), std::max(a.x, b.x),
                                        std::max(a.y, b.y)};
    const auto side = static_cast<size_t>(std::min_element(away.begin(), away.end()) - away.begin());
    EXPECT_LT(away[side], 1e-12) << what;
    // Of equal length.
    EXPECT_NEAR(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)), 1.0 / factors[side], 1e-12) << what;
    ++found[side];
  }
  for (size_t s = 0; s < 3; ++s) EXPECT_EQ(found[s], factors[s]) << what;
}

TEST(OtherPatterns, OfTrianglesTileTheDomain) {
  for (int code = 0; code < 9 * 9 * 9; ++code) {
    const Factors f = {code % 9 + 1, code / 9 % 9 + 1, code / 81 + 1, 0};
    const auto check = [&](const PatternMesh& mesh, const std::string& name) {
      expectTiling(Domain::Triangle, mesh, name + " " + named(f));
      expectSides(mesh, f, name + " " + named(f));
    };
    check(chungKimPattern(f), "Chung and Kim");
    for (int base = 0; base < 3; ++base) check(collapsedPattern(f, base), "Moreton");
    check(bruijnsPattern(BruijnsScheme::ConstantMaximum, f), "CMVS");
    check(bruijnsPattern(BruijnsScheme::LinearMaximum, f), "LMVS");
    check(kumarPattern(f), "Kumar");
  }
  for (const Factors& f : {Factors{64, 1, 1, 0}, {64, 64, 1, 0}, {37, 64, 5, 0}, {7, 13, 64, 0}}) {
    expectTiling(Domain::Triangle, chungKimPattern(f), "Chung and Kim " + named(f));
    expectTiling(Domain::Triangle, collapsedPattern(f), "Moreton " + named(f));
    expectTiling(Domain::Triangle, bruijnsPattern(BruijnsScheme::LinearMaximum, f), "LMVS " + named(f));
    expectTiling(Domain::Triangle, kumarPattern(f), "Kumar " + named(f));
  }
}

/// What the thesis says of them (section 7.3.2), for all factors to 12.
TEST(OtherPatterns, OfTrianglesHaveTheCountsOfTheThesis) {
  for (int m = 1; m <= 12; ++m) {
    const Factors uniform = {m, m, m, 0};
    const PatternMesh ours = patternMesh(Domain::Triangle, uniform);
    // "producing the same pattern for uniform factor configurations", "identical results as our approach"
    EXPECT_EQ(chungKimPattern(uniform).triangles.size(), ours.triangles.size());
    EXPECT_EQ(bruijnsPattern(BruijnsScheme::Fixed, uniform).triangles.size(), size_t(m * m));
    // Two triangles for each quad but those at the apex.
    EXPECT_EQ(collapsedPattern(uniform).triangles.size(), size_t(2 * m * m - m));
    // Slivers at the collapsed corner, of 1 / m of its angle or less.
    if (m > 1) {
      EXPECT_LT(shapeOf(Domain::Triangle, collapsedPattern(uniform)).smallestAngleDeg, 60.0 / m + 10.0);
    }
    // Core and a triangle for each segment of it and of the sides; two samples and four triangles at corners.
    if (m >= 4) {
      EXPECT_EQ(bruijnsPattern(BruijnsScheme::LinearMaximum, uniform).triangles.size(),
                size_t((m - 3) * (m - 3) + 3 * (m - 3 + 2) + 3 * m));
    }
    if (m >= 2) {
      EXPECT_EQ(kumarPattern(uniform).triangles.size(), size_t((m - 2) * (m - 2) + 3 * (m - 2) + 3 * m));
    }
  }
  for (int code = 0; code < 12 * 12 * 12; ++code) {
    const Factors f = {code % 12 + 1, code / 12 % 12 + 1, code / 144 + 1, 0};
    if (f[0] == f[1] && f[1] == f[2]) continue;
    const size_t ours = patternMesh(Domain::Triangle, f).triangles.size();
    // "this scheme yields more triangles than ours in case of non-uniform tessellation factors": as many for
    // a single transition.
    EXPECT_GE(chungKimPattern(f).triangles.size(), ours) << named(f);
    size_t least = SIZE_MAX;
    for (int base = 0; base < 3; ++base) least = std::min(least, collapsedPattern(f, base).triangles.size());
    EXPECT_EQ(bruijnsPattern(BruijnsScheme::ConstantMaximum, f).triangles.size(), least) << named(f);
    if (std::min({f[0], f[1], f[2]}) < 4) {
      EXPECT_EQ(bruijnsPattern(BruijnsScheme::LinearMaximum, f).triangles.size(), size_t(f[0] + f[1] + f[2]));
    }
  }
}

/// The table of docs/tessellation_patterns.md, which this prints: of the patterns that sample the interior as
/// densely as the largest factor asks for, ours has the fewest triangles, and of all the best-shaped ones.
TEST(OtherPatterns, OursHaveTheBestShapedTriangles) {
  using Make = std::function<PatternMesh(const Factors&)>;
  const std::vector<std::pair<const char*, Make>> patterns = {
      {"Ours", [](const Factors& f) { return patternMesh(Domain::Triangle, f); }},
      {"Ours, no correction", [](const Factors& f) { return patternMesh(Domain::Triangle, f, false); }},
      {"Direct3D 11",
       [](const Factors& f) {
         return concentricPattern(Domain::Triangle, f, glm::ivec2(std::max({f[0], f[1], f[2]})));
       }},
      {"Chung and Kim", [](const Factors& f) { return chungKimPattern(f); }},
      {"Moreton", [](const Factors& f) { return collapsedPattern(f); }},
      {"Bruijns CMVS", [](const Factors& f) { return bruijnsPattern(BruijnsScheme::ConstantMaximum, f); }},
      {"Bruijns LMVS", [](const Factors& f) { return bruijnsPattern(BruijnsScheme::LinearMaximum, f); }},
      {"Kumar", [](const Factors& f) { return kumarPattern(f); }}};
  double ours = 0.0, oursAngle = 0.0;
  for (const auto& [name, make] : patterns) {
    double triangles = 0.0, points = 0.0, angle = 0.0, least = 180.0;
    int count = 0;
    for (int code = 0; code < 16 * 16 * 16; ++code) {
      const Factors f = {code % 16 + 1, code / 16 % 16 + 1, code / 256 + 1, 0};
      const PatternShape shape = shapeOf(Domain::Triangle, make(f));
      triangles += double(shape.triangles), points += double(shape.points), angle += shape.smallestAngleDeg;
      least = std::min(least, shape.smallestAngleDeg);
      ++count;
    }
    std::printf("| %s | %.1f | %.1f | %.1f | %.2f |\n", name, triangles / count, points / count,
                angle / count, least);
    const std::string which = name;
    if (which == "Ours") {
      ours = triangles, oursAngle = angle;
      continue;
    }
    EXPECT_GT(oursAngle, angle) << name;
    if (which == "Direct3D 11" || which == "Chung and Kim" || which == "Moreton") {
      EXPECT_LT(ours, triangles) << name;
    }
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
