// SPDX-License-Identifier: BSD-3-Clause
// Lane and Carpenter's scan lines (SC-36) against rays by interval arithmetic.
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class ScanLines : public TechniqueTest {};

/// A pixel's centre may change sides where a silhouette passes within the tolerance, t px: of a silhouette L
/// px long, at most 2 t L do on average, and the solids' are less than 1,000 px long here (a diagonal of the
/// picture is 200).
TEST_F(ScanLines, SeeWhatRaysSee) {
  for (const char* name : {"curved/teapot", "curved/nurbs_solids", "curved/double_torus"}) {
    const scene::Scene scene = makeScene(name);
    const Rendered made =
        render(scene, "isocurves/lane_carpenter", {{"tolerance_px", 0.02}}, {160, 120}, true);
    EXPECT_GT(made.counter("surface_px"), 1500) << name;
    EXPECT_LE(made.counter("missed_px") + made.counter("false_px"), 2 * 0.02 * 1000) << name;
    EXPECT_LE(made.counter("wrong_place_px"), 2 * 0.02 * 1000) << name;
    EXPECT_GT(made.counter("active_most"), 0) << name;
  }
}

TEST_F(ScanLines, TakeFewerPartsWhereMoreIsTolerated) {
  const scene::Scene teapot = makeScene("curved/teapot");
  double last = 1e9;
  for (const double tolerance : {0.05, 0.2, 0.8}) {
    const Rendered made = render(teapot, "isocurves/lane_carpenter",
                                 {{"tolerance_px", tolerance}, {"check", false}}, {96, 72}, true);
    // The deviation falls with the square of a part's length: of four times the tolerance, half in each
    // direction.
    EXPECT_LT(made.counter("flat_parts"), last / 2) << tolerance;
    last = made.counter("flat_parts");
  }
}

/// Parts that are halved differently meet along chords: no pixel inside shows what lies behind, however much
/// is tolerated. A hole is a pixel that all rays around its centre hit; a wrong place may also be a
/// silhouette's that moved by the tolerance, of 1,000 px at most.
TEST_F(ScanLines, LeaveNoGapsBetweenParts) {
  for (const char* name : {"curved/teapot", "curved/nurbs_solids"}) {
    const scene::Scene scene = makeScene(name);
    for (const double tolerance : {0.125, 0.25, 0.5}) {
      const Rendered made =
          render(scene, "isocurves/lane_carpenter", {{"tolerance_px", tolerance}}, {160, 120}, true);
      EXPECT_EQ(made.counter("hole_px"), 0) << name << ' ' << tolerance;
      EXPECT_LE(made.counter("wrong_place_px"), 2 * tolerance * 1000) << name << ' ' << tolerance;
    }
  }
}

}  // namespace
}  // namespace limen::techniques
