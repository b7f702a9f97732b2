// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/patterns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

namespace limen::surfaces {
namespace {

struct Emitted {
  std::vector<glm::dvec2> points;
  std::vector<uint32_t> indices;
  std::vector<glm::uvec3> triangles;
};

Emitted emit(const PatternPlan& plan) {
  Emitted out;
  for (int slot = 0; slot < plan.vertices; ++slot) out.points.push_back(parametersOf(plan, slot));
  out.indices = patternIndices(plan);
  out.triangles = stripTriangles(out.indices);
  return out;
}

double signedArea(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

glm::dvec2 corner(Domain domain, int index) {
  if (domain == Domain::Triangle)
    return index == 0 ? glm::dvec2(1, 0) : index == 1 ? glm::dvec2(0, 1) : glm::dvec2(0);
  return glm::dvec2(index == 1 || index == 2, index >= 2);
}

/// Vertices, triangles and indices of a rectangle, as the specification states them (SC-47).
std::array<int, 3> rectangleCounts(const Factors& f) {
  const int mS = f[0], mE = f[1], mN = f[2], mW = f[3];
  const int mu = std::min(mS, mN), mv = std::min(mW, mE), tu = mS != mN, tv = mW != mE, rows = mv - tu,
            cols = mu - tv, nu = std::max(mS, mN), nv = std::max(mW, mE);
  return {(rows + 1) * (cols + 1) + tu * (nu + 1) + tv * (nv + 1) - tu * tv,
          2 * rows * cols + tu * (nu + cols) + tv * (nv + rows),
          (cols > 0 ? rows * (2 * cols + 3) : 0) + 4 * (tu * (nu + cols) + tv * (nv + rows))};
}

/// The same of a triangle (SC-48).
std::array<int, 3> triangleCounts(const Factors& f) {
  const int most = std::max({f[0], f[1], f[2]});
  int strips = 0, outer = 0;
  for (int side = 0; side < 3; ++side)
    if (f[size_t(side)] < most) ++strips, outer += f[size_t(side)];
  const int c = most - strips, t = c * c + strips * c + outer;
  const int v = strips == 0   ? (most + 1) * (most + 2) / 2
                : strips == 1 ? most * (most + 1) / 2 + outer + 1
                              : (most - 1) * most / 2 + outer + 1;
  return {v, t, c * c + 3 * c + 4 * (strips * c + outer)};
}

std::string text(const Factors& f) {
  std::string out;
  for (const int factor : f) out += std::to_string(factor) + " ";
  return out;
}

/// Everything that must hold of any pattern; what is not stated in closed form is found from the triangles.
void expectSound(Domain domain, const Factors& factors, bool fix) {
  const PatternPlan plan = patternOf(domain, factors, fix);
  const Emitted emitted = emit(plan);
  const std::array<int, 3> counts =
      domain == Domain::Rectangle ? rectangleCounts(factors) : triangleCounts(factors);
  ASSERT_EQ(plan.vertices, counts[0]) << text(factors);
  ASSERT_EQ(plan.triangles, counts[1]) << text(factors);
  ASSERT_EQ(plan.indices, counts[2]) << text(factors);
  ASSERT_EQ(static_cast<int>(emitted.triangles.size()), plan.triangles) << text(factors);
  for (int i = 0; i < plan.triangles; ++i)
    ASSERT_EQ(glm::uvec3(patternTriangle(plan, i)), emitted.triangles[size_t(i)]) << text(factors) << i;
  double area = 0.0;
  std::vector<bool> used(emitted.points.size());
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const glm::uvec3& t : emitted.triangles) {
    for (int i = 0; i < 3; ++i) {
      ASSERT_LT(t[i], emitted.points.size()) << text(factors);
      used[t[i]] = true;
      ++edges[{t[i], t[(i + 1) % 3]}];
    }
    const double of = signedArea(emitted.points[t.x], emitted.points[t.y], emitted.points[t.z]);
    // The smallest possible triangle stands on a segment of 1 / 64 and is 1 / 64 high.
    ASSERT_GT(of, 0.5 / 64 / 64 - 1e-9) << text(factors);
    area += of;
  }
  ASSERT_NEAR(area, domain == Domain::Rectangle ? 1.0 : 0.5, 1e-12) << text(factors);
  for (size_t i = 0; i < used.size(); ++i) ASSERT_TRUE(used[i]) << text(factors) << "vertex " << i;
  std::set<std::pair<double, double>> places;
  for (const glm::dvec2& point : emitted.points)
    ASSERT_TRUE(places.emplace(point.x, point.y).second) << text(factors) << "two vertices in one place";
  // Each directed edge once; those without their opposite are the sides' segments, as many as the factors
  // say.
  std::array<int, 4> segments{};
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << text(factors);
    if (edges.count({edge.second, edge.first})) continue;
    const glm::dvec2 a = emitted.points[edge.first], b = emitted.points[edge.second];
    const int sides = sidesOf(domain);
    int on = -1;
    for (int side = 0; side < sides; ++side) {
      const glm::dvec2 from = corner(domain, side), to = corner(domain, (side + 1) % sides);
      if (std::abs(signedArea(from, to, a)) < 1e-12 && std::abs(signedArea(from, to, b)) < 1e-12) on = side;
    }
    ASSERT_GE(on, 0) << text(factors) << "an open edge inside the domain";
    ++segments[size_t(on)];
    const glm::dvec2 whole = corner(domain, (on + 1) % sides) - corner(domain, on);
    ASSERT_NEAR(glm::length(b - a) * factors[size_t(on)], glm::length(whole), 1e-12) << text(factors);
  }
  for (int side = 0; side < sidesOf(domain); ++side)
    ASSERT_EQ(segments[size_t(side)], factors[size_t(side)]) << text(factors);
}

void forEachTuple(int sides, int most, const std::function<void(const Factors&)>& visit) {
  Factors f{1, 1, 1, 1};
  for (;;) {
    visit(f);
    int at = 0;
    while (at < sides && f[size_t(at)] == most) f[size_t(at++)] = 1;
    if (at == sides) return;
    ++f[size_t(at)];
  }
}

/// A side's slots hold its samples, from its first corner on.
TEST(Patterns, SlotsOfSidesHoldTheirSamples) {
  for (const Domain domain : {Domain::Rectangle, Domain::Triangle})
    for (int code = 0; code < 6 * 6 * 6 * 6; ++code) {
      const Factors f = {code % 6 + 1, code / 6 % 6 + 1, code / 36 % 6 + 1, code / 216 + 1};
      if (domain == Domain::Triangle && f[3] > 1) break;
      const PatternPlan plan = patternOf(domain, f);
      for (int side = 0; side < sidesOf(domain); ++side) {
        const int n = f[size_t(side)];
        const glm::dvec2 a = corner(domain, side), b = corner(domain, (side + 1) % sidesOf(domain));
        for (int q = 1; q < n; ++q) {
          const glm::dvec2 at = parametersOf(plan, patternSideSlot(plan, side, q, n));
          EXPECT_LT(glm::length(at - (a + (b - a) * (double(q) / n))), 1e-12)
              << code << " side " << side << " sample " << q;
        }
      }
    }
}

TEST(Patterns, TrianglesOfAllTuplesTo16TileTheDomainAndMatchTheClosedForm) {
  forEachTuple(3, 16, [](const Factors& f) {
    expectSound(Domain::Triangle, f, true);
    expectSound(Domain::Triangle, f, false);
  });
}

TEST(Patterns, RectanglesOfAllTuplesTo8TileTheDomainAndMatchTheClosedForm) {
  forEachTuple(4, 8, [](const Factors& f) {
    expectSound(Domain::Rectangle, f, true);
    expectSound(Domain::Rectangle, f, false);
  });
}

TEST(Patterns, RandomTuplesTo64TileTheDomainAndMatchTheClosedForm) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(1, 64);
  for (int i = 0; i < 60; ++i) {
    const Factors f{any(random), any(random), any(random), any(random)};
    expectSound(Domain::Rectangle, f, i % 2 == 0);
    expectSound(Domain::Triangle, f, i % 2 == 0);
  }
  for (const Factors& f :
       {Factors{64, 1, 64, 1}, Factors{1, 1, 1, 64}, Factors{64, 64, 1, 1}, Factors{64, 1, 1, 64}}) {
    expectSound(Domain::Rectangle, f, true);
    expectSound(Domain::Triangle, f, true);
  }
}

// Schwarz 2009, table 7.3: patterns and indices of all triples of factors, all of powers of two, and all with
// three equal factors.
TEST(Patterns, IndexTotalsAreThoseOfTable73) {
  struct Row {
    int most;
    int64_t all, dyadic, uniform, uniformDyadic;
  };
  const std::vector<Row> table = {{4, 2028, 774, 60, 42},
                                  {8, 48696, 5086, 312, 130},
                                  {16, 1153520, 27770, 1904, 434},
                                  {32, 29034976, 142902, 13024, 1554},
                                  {64, 790916032, 725206, 95680, 5842}};
  const auto dyadic = [](int n) { return (n & (n - 1)) == 0; };
  for (const Row& row : table) {
    Row sum{row.most, 0, 0, 0, 0};
    forEachTuple(3, row.most, [&](const Factors& f) {
      const int64_t indices = patternOf(Domain::Triangle, f).indices;
      const bool powers = dyadic(f[0]) && dyadic(f[1]) && dyadic(f[2]), same = f[0] == f[1] && f[1] == f[2];
      sum.all += indices;
      if (powers) sum.dyadic += indices;
      if (same) sum.uniform += indices;
      if (powers && same) sum.uniformDyadic += indices;
    });
    EXPECT_EQ(sum.all, row.all) << row.most;
    EXPECT_EQ(sum.dyadic, row.dyadic) << row.most;
    EXPECT_EQ(sum.uniform, row.uniform) << row.most;
    EXPECT_EQ(sum.uniformDyadic, row.uniformDyadic) << row.most;
  }
}

// The state machine as Moreton gives it, run step by step.
TEST(Patterns, StripsFollowTheStateMachine) {
  for (int m = 1; m <= 70; ++m)
    for (int n = 1; n <= 70; ++n) {
      int q = m - n, inner = 0, outer = 0;
      for (int step = 0; step < m + n; ++step) {
        ASSERT_EQ(patternInnerSteps(step, m, n), inner) << m << " " << n << " " << step;
        if (q >= 0) {
          ++inner;
          q -= 2 * n;
        } else {
          ++outer;
          q += 2 * m;
        }
      }
      ASSERT_EQ(inner, m);
      ASSERT_EQ(outer, n);
    }
}

// "One temporary inner segment at the abutting end, then collapse it."
TEST(Patterns, CorrectedStripsAreTheStateMachineWithoutItsTemporarySegment) {
  for (int m = 0; m <= 64; ++m)
    for (int n = 1; n <= 64; ++n) {
      int q = m + 1 - n, inner = 0;
      bool taken = false;
      std::vector<int> before;
      while (static_cast<int>(before.size()) < m + n) {
        if (q >= 0) {
          q -= 2 * n;
          if (taken) {
            before.push_back(inner++);
          }
          taken = true;
        } else {
          q += 2 * (m + 1);
          before.push_back(inner);
        }
      }
      for (int step = 0; step < m + n; ++step)
        ASSERT_EQ(patternFixedSteps(step, m, n), before[size_t(step)]) << m << " " << n << " " << step;
    }
}

double smallestAngle(Domain domain, const Factors& factors, bool fix) {
  const Emitted emitted = emit(patternOf(domain, factors, fix));
  double least = 180.0;
  for (const glm::uvec3& t : emitted.triangles)
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 at = emitted.points[t[i]], a = emitted.points[t[(i + 1) % 3]] - at,
                       b = emitted.points[t[(i + 2) % 3]] - at;
      least = std::min(
          least,
          glm::degrees(std::acos(glm::clamp(glm::dot(a, b) / glm::length(a) / glm::length(b), -1.0, 1.0))));
    }
  return least;
}

TEST(Patterns, TheCornerFixWidensTheSmallestAngleOfAdjoiningTransitions) {
  for (const Domain domain : {Domain::Triangle, Domain::Rectangle}) {
    int adjoining = 0, wider = 0, narrower = 0;
    double with = 0.0, without = 0.0;
    forEachTuple(sidesOf(domain), domain == Domain::Triangle ? 16 : 7, [&](const Factors& f) {
      const PatternPlan plan = patternOf(domain, f);
      if (plan.first.side < 0 || plan.second.side < 0) return;
      const double fixed = smallestAngle(domain, f, true), plain = smallestAngle(domain, f, false);
      ++adjoining;
      with += fixed;
      without += plain;
      if (fixed > plain + 1e-9) ++wider;
      if (fixed < plain - 1e-9) ++narrower;
    });
    RecordProperty(domain == Domain::Triangle ? "triangles_wider" : "rectangles_wider", wider);
    EXPECT_GT(with, without);
    EXPECT_GT(wider, 4 * narrower) << "of " << adjoining << ", narrower: " << narrower << ", mean "
                                   << with / adjoining << " against " << without / adjoining;
    EXPECT_GT(wider, 0);
  }
}

}  // namespace
}  // namespace limen::surfaces
