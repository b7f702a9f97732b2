// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/recursion.h"

#include <gtest/gtest.h>

#include <map>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/teapot.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/pn_set.h"
#include "renderer/surfaces/surface_errors.h"

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

TEST_F(Recursion, SnappedSidesLeaveTVerticesWithoutGaps) {
  const PatchSet teapot = teapotSet();
  const SurfaceView view = viewFrom({2.5, 3.5, 3}, {0, 1.5, 0});
  for (const SplitPolicy split : {SplitPolicy::Halves, SplitPolicy::Quarters, SplitPolicy::Mixed}) {
    RecursionSettings settings{.split = split, .tolerancePx = 4.0, .cull = false};
    const TessellatedSurface open = refined(teapot, view, settings);
    settings.snap = true;
    const TessellatedSurface snapped = refined(teapot, view, settings);
    EXPECT_GT(cracksOf(teapot, snapped).loneVertices, 0) << toText(split);
    EXPECT_GT(largestGap(teapot, open), 1e-3) << toText(split);
    EXPECT_LT(largestGap(teapot, snapped), 1e-6) << toText(split);
    EXPECT_NEAR(coveredArea(snapped), 32.0, 1e-9);
  }
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
