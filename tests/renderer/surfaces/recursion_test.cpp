// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/recursion.h"

#include <gtest/gtest.h>

#include <map>

#include "experiments/base/error.h"
#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/teapot.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/central_differences.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/pn_set.h"
#include "renderer/surfaces/surface_errors.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;

std::vector<dvec3> curve(std::initializer_list<dvec2> points) {
  std::vector<dvec3> out;
  for (const dvec2 p : points) out.emplace_back(p, 1.0);
  return out;
}

// Control point polygons whose distances can be read off.
TEST(Flatness, OfCurvesIsWhatTheDrawingShows) {
  const auto arch = curve({{0, 0}, {0, 2}, {3, 2}, {3, 0}});
  EXPECT_DOUBLE_EQ(curveFlatness(Flatness::Control, arch), 2.0);
  EXPECT_DOUBLE_EQ(curveFlatness(Flatness::Line, arch), 2.0);
  EXPECT_DOUBLE_EQ(curveFlatness(Flatness::Corresponding, arch), std::sqrt(5.0));  // from (1, 0) to (0, 2)
  EXPECT_DOUBLE_EQ(curveFlatness(Flatness::Midpoint, arch), 1.5);
  EXPECT_DOUBLE_EQ(curveFlatness(Flatness::Length, arch), 7.0 - 3.0);
}

TEST(Flatness, MidpointsMissAnSCurveAndControlPointsDoNot) {
  const auto s = curve({{0, 0}, {1, 3}, {2, -3}, {3, 0}});
  EXPECT_NEAR(curveFlatness(Flatness::Midpoint, s), 0.0, 1e-12);
  EXPECT_NEAR(curveFlatness(Flatness::ParameterMidpoint, s), 0.0, 1e-12);
  EXPECT_GT(curveFlatness(Flatness::Control, s), 2.9);
  EXPECT_GT(curveFlatness(Flatness::Corresponding, s), 2.9);
  EXPECT_GT(curveFlatness(Flatness::Differences, s), 2.9);
  EXPECT_GT(curveFlatness(Flatness::Length, s), 2.9);
}

TEST(Flatness, DistancesFromTheLineMissALoop) {
  const auto overshoot = curve({{0, 0}, {8, 0}, {-5, 0}, {3, 0}});
  EXPECT_EQ(curveFlatness(Flatness::Line, overshoot), 0.0);
  EXPECT_DOUBLE_EQ(curveFlatness(Flatness::Control, overshoot), 5.0);
  EXPECT_DOUBLE_EQ(curveFlatness(Flatness::Corresponding, overshoot), 7.0);
}

class Recursion : public testing::Test {
 protected:
  static SurfaceView viewFrom(dvec3 eye, dvec3 target) {
    SurfaceView view;
    view.eye = eye;
    view.forward = glm::normalize(target - eye);
    view.right = glm::normalize(glm::cross(view.forward, dvec3(0, 1, 0)));
    view.up = glm::cross(view.right, view.forward);
    view.tanHalf = dvec2(4.0 / 3.0 * 0.4, 0.4);
    view.pxAtDistance = 768 / (2.0 * 0.4);
    view.nearest = 0.01;
    return view;
  }
  static PatchSet teapotSet() {
    PatchSet set = scene::teapot();
    findNeighbours(set);
    return set;
  }
  static PatchSet torusSet() { return pnSet(scene::doubleTorus()); }
  /// Sum of the domains' areas that triangles cover, over the patches that are drawn.
  static double coveredArea(const TessellatedSurface& surface) {
    double sum = 0.0;
    for (const glm::uvec3& t : surface.triangles) {
      const DomainPoint &a = surface.parameters[t.x], &b = surface.parameters[t.y],
                        &c = surface.parameters[t.z];
      const double area = 0.5 * ((b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u));
      EXPECT_GT(area, 0.0);
      sum += area;
    }
    return sum;
  }
};

TEST_F(Recursion, CoversEachDomainOnce) {
  const PatchSet teapot = teapotSet(), torus = torusSet();
  for (const SplitPolicy split :
       {SplitPolicy::Halves, SplitPolicy::Quarters, SplitPolicy::Mixed, SplitPolicy::Restricted}) {
    const RecursionSettings settings{.split = split, .tolerancePx = 4.0, .cull = false};
    EXPECT_NEAR(coveredArea(refined(teapot, viewFrom({6, 5, 9}, {0, 1.5, 0}), settings)), 32.0, 1e-9)
        << toText(split);
    EXPECT_NEAR(coveredArea(refined(torus, viewFrom({3, 9, 12}, {0, 0, 0}), settings)), 1536 * 0.5, 1e-6)
        << toText(split);
  }
}

// The hull of a side's control points contains the side: its distance from the chord on the screen is
// bounded.
TEST_F(Recursion, KeepsTheToleranceAlongSides) {
  const PatchSet teapot = teapotSet();
  const SurfaceView view = viewFrom({6, 5, 9}, {0, 1.5, 0});
  const auto screen = [&](dvec3 p) {
    p -= view.eye;
    return view.pxAtDistance * dvec2(glm::dot(view.right, p), glm::dot(view.up, p)) /
           glm::dot(view.forward, p);
  };
  for (const double tolerance : {0.5, 2.0}) {
    RecursionCounts counts;
    const RecursionSettings settings{.split = SplitPolicy::Quarters, .tolerancePx = tolerance};
    const TessellatedSurface surface = refined(teapot, view, settings, {}, &counts);
    EXPECT_EQ(counts.cutShort, 0);
    double most = 0.0;
    for (const glm::uvec3& t : surface.triangles)
      for (int e = 0; e < 3; ++e) {
        const uint32_t from = t[e], to = t[(e + 1) % 3];
        const DomainPoint &a = surface.parameters[from], &b = surface.parameters[to];
        if (a.u != b.u && a.v != b.v) continue;  // the diagonal
        const Patch& patch = teapot.patches[surface.patches[from]];
        const dvec2 p = screen(surface.positions[from]), d = dvec2(screen(surface.positions[to])) - p;
        for (const double s : {0.25, 0.5, 0.75}) {
          const DomainPoint at = rectanglePoint(glm::mix(a.u, b.u, s), glm::mix(a.v, b.v, s));
          const dvec2 q = screen(evaluate(teapot, patch, at, Order::Position).p) - p;
          const double length = glm::dot(d, d),
                       along = length > 0.0 ? glm::clamp(glm::dot(q, d) / length, 0.0, 1.0) : 0.0;
          most = std::max(most, glm::length(q - along * d));
        }
      }
    EXPECT_LT(most, tolerance + 1e-3);  // vertices are floats
    EXPECT_GT(most, 0.2 * tolerance);
  }
}

TEST_F(Recursion, RestrictedPartsLeaveNoTVertex) {
  const RecursionSettings settings{.split = SplitPolicy::Restricted, .tolerancePx = 2.0, .cull = false};
  const PatchSet teapot = teapotSet(), torus = torusSet();
  const SurfaceView near = viewFrom({2.5, 3.5, 3}, {0, 1.5, 0}), above = viewFrom({1, 5, 4}, {0, 0, 0});
  for (const PatchSet* set : {&teapot, &torus}) {
    const TessellatedSurface surface = refined(*set, set == &teapot ? near : above, settings);
    const Cracks cracks = cracksOf(*set, surface);
    EXPECT_GT(cracks.sides, 50);
    EXPECT_EQ(cracks.loneVertices, 0);
    EXPECT_EQ(cracks.openEdges, 0);
    EXPECT_EQ(cracks.unequalVertices, 0);
    EXPECT_EQ(cracks.foldOvers, 0);
  }
}

// Without restriction there are T-vertices, or the check above shows nothing.
TEST_F(Recursion, QuartersAloneLeaveTVertices) {
  const PatchSet teapot = teapotSet();
  const TessellatedSurface surface =
      refined(teapot, viewFrom({2.5, 3.5, 3}, {0, 1.5, 0}),
              {.split = SplitPolicy::Quarters, .tolerancePx = 2.0, .cull = false});
  const Cracks cracks = cracksOf(teapot, surface);
  EXPECT_GT(cracks.loneVertices + cracks.openEdges, 0);
}

// Sides are split by what is known of them alone, so both triangles along one agree: no cracks, no
// T-vertices.
TEST_F(Recursion, TrianglesSplitAtTheirSidesAreWatertight) {
  const PatchSet torus = torusSet();
  for (const Flatness flatness : {Flatness::Control, Flatness::Corresponding, Flatness::Midpoint}) {
    const TessellatedSurface surface = refined(torus, viewFrom({1, 5, 4}, {0, 0, 0}),
                                               {.flatness = flatness, .tolerancePx = 0.5, .cull = false});
    const Cracks cracks = cracksOf(torus, surface);
    EXPECT_EQ(cracks.loneVertices, 0) << toText(flatness);
    EXPECT_EQ(cracks.openEdges, 0) << toText(flatness);
    EXPECT_EQ(cracks.unequalVertices, 0) << toText(flatness);
  }
}

/// Largest distance of a patch's vertices on common sides from the other patch's edges along them.
double largestGap(const PatchSet& set, const TessellatedSurface& surface) {
  std::map<std::pair<uint32_t, int>, std::map<double, dvec3>> sides;
  for (size_t i = 0; i < surface.positions.size(); ++i) {
    const double u = surface.parameters[i].u, v = surface.parameters[i].v;
    const auto add = [&](int side, double t) { sides[{surface.patches[i], side}][t] = surface.positions[i]; };
    if (v == 0.0) add(0, u);
    if (u == 1.0) add(1, v);
    if (v == 1.0) add(2, 1.0 - u);
    if (u == 0.0) add(3, 1.0 - v);
  }
  double gap = 0.0;
  for (const auto& [place, vertices] : sides) {
    const Neighbour& other = set.neighbours[place.first][static_cast<size_t>(place.second)];
    if (other.patch < 0) continue;
    const auto& there = sides[{static_cast<uint32_t>(other.patch), other.side}];
    for (const auto& [t, p] : vertices) {
      const double at = other.reversed ? 1.0 - t : t;
      const auto after = there.lower_bound(at);
      if (after == there.end() || after->first == at || after == there.begin()) continue;
      const dvec3 a = std::prev(after)->second, d = after->second - a;
      const double along = glm::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
      gap = std::max(gap, glm::length(p - a - along * d));
    }
  }
  return gap;
}

TEST_F(Recursion, SnappedAndAlteredSidesLeaveTVerticesWithoutGaps) {
  const PatchSet teapot = teapotSet();
  const SurfaceView view = viewFrom({2.5, 3.5, 3}, {0, 1.5, 0});
  for (const SplitPolicy split : {SplitPolicy::Halves, SplitPolicy::Quarters, SplitPolicy::Mixed}) {
    RecursionSettings settings{.split = split, .tolerancePx = 4.0, .cull = false};
    const TessellatedSurface open = refined(teapot, view, settings);
    EXPECT_GT(largestGap(teapot, open), 1e-3) << toText(split);
    for (const CrackHandling cracks : {CrackHandling::Snap, CrackHandling::Alter}) {
      settings.cracks = cracks;
      const TessellatedSurface closed = refined(teapot, view, settings);
      EXPECT_GT(cracksOf(teapot, closed).loneVertices, 0) << toText(split) << " " << toText(cracks);
      EXPECT_LT(largestGap(teapot, closed), 1e-6) << toText(split) << " " << toText(cracks);
      EXPECT_NEAR(coveredArea(closed), 32.0, 1e-9);
    }
  }
}

/// Largest distance of a surface's vertices from where the patches have them.
double largestOffset(const PatchSet& set, const TessellatedSurface& surface) {
  double most = 0.0;
  for (size_t i = 0; i < surface.positions.size(); ++i) {
    const dvec3 p = evaluate(set, set.patches[surface.patches[i]], surface.parameters[i], Order::Position).p;
    most = std::max(most, glm::length(p - dvec3(surface.positions[i])));
  }
  return most;
}

// Clark's way changes the patch: vertices off the side that was flat move as well.
TEST_F(Recursion, AlteredSidesMoveTheInterior) {
  const PatchSet teapot = teapotSet();
  const SurfaceView view = viewFrom({2.5, 3.5, 3}, {0, 1.5, 0});
  RecursionSettings settings{.split = SplitPolicy::Quarters, .tolerancePx = 4.0, .cull = false};
  const auto movedInside = [&](CrackHandling cracks) {
    settings.cracks = cracks;
    const TessellatedSurface surface = refined(teapot, view, settings);
    const TessellatedSurface plain =
        refined(teapot, view, {.split = SplitPolicy::Quarters, .tolerancePx = 4.0, .cull = false});
    std::map<std::tuple<uint32_t, double, double>, dvec3> places;
    for (size_t i = 0; i < plain.positions.size(); ++i)
      places[{plain.patches[i], plain.parameters[i].u, plain.parameters[i].v}] = plain.positions[i];
    int64_t moved = 0;
    for (size_t i = 0; i < surface.positions.size(); ++i) {
      const auto found = places.find({surface.patches[i], surface.parameters[i].u, surface.parameters[i].v});
      moved += found != places.end() && glm::length(found->second - dvec3(surface.positions[i])) > 1e-6;
    }
    return moved;
  };
  EXPECT_GT(movedInside(CrackHandling::Alter), movedInside(CrackHandling::Snap));
}

TEST_F(Recursion, PathsAreWatertightAndCoverEachDomainOnce) {
  const RecursionSettings settings{.split = SplitPolicy::Paths, .tolerancePx = 1.0, .cull = false};
  const PatchSet teapot = teapotSet(), torus = torusSet();
  // From so near that patches pass the eye's plane.
  const TessellatedSurface pot = refined(teapot, viewFrom({2.5, 3.5, 3}, {0, 1.5, 0}), settings);
  const TessellatedSurface rings = refined(torus, viewFrom({1, 5, 4}, {0, 0, 0}), settings);
  EXPECT_GT(pot.triangles.size(), 500U);
  EXPECT_NEAR(coveredArea(pot), 32.0, 1e-9);
  EXPECT_NEAR(coveredArea(rings), 1536 * 0.5, 1e-6);
  EXPECT_LT(largestOffset(teapot, pot), 1e-5);
  for (const Cracks& cracks : {cracksOf(teapot, pot), cracksOf(torus, rings)}) {
    EXPECT_EQ(cracks.loneVertices, 0);
    EXPECT_EQ(cracks.openEdges, 0);
  }
}

/// A bicubic patch over the unit square whose points b12 and b21 are raised and lowered: sides and the
/// diagonal stay straight.
PatchSet saddle(double height) {
  std::vector<glm::dvec4> points;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      points.emplace_back(i / 3.0, j / 3.0,
                          i == 1 && j == 2   ? height
                          : i == 2 && j == 1 ? -height
                                             : 0.0,
                          1.0);
  PatchSet set;
  addRectangle(set, 3, 3, points);
  findNeighbours(set);
  return set;
}

// What no curve of the triangulation passes is missed; tests of all control points see it.
TEST_F(Recursion, PathsMissWhatTheirCurvesDoNotMeet) {
  const PatchSet set = saddle(1.0);
  // From the side, so that heights are seen.
  const SurfaceView view = viewFrom({0.5, -3.0, 1.0}, {0.5, 0.5, 0.0});
  const TessellatedSurface paths =
      refined(set, view, {.split = SplitPolicy::Paths, .tolerancePx = 1.0, .cull = false});
  EXPECT_EQ(paths.triangles.size(), 2U);
  EXPECT_GT(refined(set, view, {.split = SplitPolicy::Quarters, .tolerancePx = 1.0, .cull = false})
                .triangles.size(),
            50U);
}

/// A random bicubic polynomial by its Bézier points, and its records from exact derivatives.
struct Bicubic {
  std::array<double, 16> b;
  static double bernstein(int i, double t) {
    const double s = 1.0 - t;
    return i == 0 ? s * s * s : i == 1 ? 3 * s * s * t : i == 2 ? 3 * s * t * t : t * t * t;
  }
  /// Second derivatives of the Bernstein polynomials of degree 3.
  static double second(int i, double t) {
    const double s = 1.0 - t;
    return i == 0 ? 6 * s : i == 1 ? -12 * s + 6 * t : i == 2 ? 6 * s - 12 * t : 6 * t;
  }
  template <class Along, class Across>
  double sum(const Along& alongU, const Across& alongV, double u, double v) const {
    double out = 0.0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) out += b[static_cast<size_t>(i + 4 * j)] * alongU(i, u) * alongV(j, v);
    return out;
  }
  CentralRecord<double> record(double u, double v) const {
    return {sum(bernstein, bernstein, u, v), sum(second, bernstein, u, v), sum(bernstein, second, u, v),
            sum(second, second, u, v)};
  }
};

// Second differences over a part are the derivatives times the squares of its extents.
TEST(CentralDifferences, AreThoseOfTheSplitPatch) {
  scene::Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Bicubic f;
    for (double& one : f.b) one = random.uniform(-1, 1);
    double low = 0.0, high = 1.0;
    CentralRecord<double> a = f.record(0, 0), b = f.record(1, 0), c = f.record(0, 1), d = f.record(1, 1);
    for (int level = 0; level < 12; ++level) {
      // Into the half along u that a random choice says, then into the lower one along v.
      const CentralRecord<double> ab = middleAlongU(a, b), cd = middleAlongU(c, d);
      const bool upper = random.uniform(0, 1) < 0.5;
      (upper ? low : high) = 0.5 * (low + high);
      a = halvedAlongU(upper ? ab : a), b = halvedAlongU(upper ? b : ab);
      c = halvedAlongU(upper ? cd : c), d = halvedAlongU(upper ? d : cd);
      const CentralRecord<double> ac = middleAlongV(a, c), bd = middleAlongV(b, d);
      a = halvedAlongV(a), b = halvedAlongV(b), c = halvedAlongV(ac), d = halvedAlongV(bd);
      const double v = std::ldexp(1.0, -(level + 1)), squareU = (high - low) * (high - low), squareV = v * v;
      const CentralRecord<double> exact = f.record(high, v);
      EXPECT_NEAR(d.p, exact.p, 1e-12);
      EXPECT_NEAR(d.uu, exact.uu * squareU, 1e-12);
      EXPECT_NEAR(d.vv, exact.vv * squareV, 1e-12);
      EXPECT_NEAR(d.uuvv, exact.uuvv * squareU * squareV, 1e-12);
    }
  }
}

// Catmull's basis: 1 - t, -t^3 / 3 + t^2 - 2 t / 3, t^3 / 3 - t / 3 and t, of the ends and half of the second
// differences there, with the middle (c0 + c3) / 2 - (c1 + c2) / 8.
TEST(CentralDifferences, AreCatmullsBasis) {
  scene::Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    Bicubic f{};
    for (size_t i = 0; i < 4; ++i)
      for (size_t j = 0; j < 4; ++j) f.b[i + 4 * j] = j == 0 ? random.uniform(-1, 1) : f.b[i];
    const CentralRecord<double> from = f.record(0, 0), to = f.record(1, 0);
    const double c0 = from.p, c1 = 0.5 * from.uu, c2 = 0.5 * to.uu, c3 = to.p;
    EXPECT_NEAR(middleAlongU(from, to).p, 0.5 * (c0 + c3) - 0.125 * (c1 + c2), 1e-15);
    for (const double t : {0.1, 0.5, 0.8})
      EXPECT_NEAR(
          f.record(t, 0).p,
          c0 * (1 - t) + c1 * (-t * t * t / 3 + t * t - 2 * t / 3) + c2 * (t * t * t / 3 - t / 3) + c3 * t,
          1e-14);
  }
}

TEST_F(Recursion, CentralDifferencesRefineAsBezierSplitsDo) {
  const PatchSet teapot = teapotSet();
  const SurfaceView view = viewFrom({6, 5, 9}, {0, 1.5, 0});
  RecursionCounts counts;
  const TessellatedSurface surface =
      refined(teapot, view, {.split = SplitPolicy::CentralDifferences, .tolerancePx = 1.0, .cull = false}, {},
              &counts);
  EXPECT_EQ(counts.cutShort, 0);
  EXPECT_GT(surface.triangles.size(), 500U);
  EXPECT_NEAR(coveredArea(surface), 32.0, 1e-9);
  EXPECT_LT(largestOffset(teapot, surface), 1e-6);  // vertices are floats
  EXPECT_THROW(refined(torusSet(), view, {.split = SplitPolicy::CentralDifferences}), Error);
}

TEST_F(Recursion, PartsThroughTheEyePlaneAreSplitToTheLimit) {
  const PatchSet teapot = teapotSet();
  RecursionCounts counts;
  const TessellatedSurface surface = refined(teapot, viewFrom({0, 1.2, 0.2}, {0, 1.2, -1}),
                                             {.tolerancePx = 4.0, .mostSteps = 8}, {}, &counts);
  EXPECT_LE(counts.steps, 8);
  EXPECT_GT(surface.triangles.size(), 0U);
  for (const glm::vec3& p : surface.positions) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
}

}  // namespace
}  // namespace limen::surfaces
