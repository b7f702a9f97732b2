// SPDX-License-Identifier: BSD-3-Clause
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class Isocurves : public TechniqueTest {};
constexpr glm::ivec2 kIsocurvesSize{96, 72};

// With two points a pixel in both directions no pixel inside is left empty; those at silhouettes are filled
// if any part of them is covered, not their middle alone.
TEST_F(Isocurves, LeaveNoHoleAtHalfAPixel) {
  for (const char* name : {"curved/teapot", "curved/sheet"})
    for (const char* stepping : {"uniform", "adaptive", "adaptive_curves", "hybrid"}) {
      // Twenty patches curve by curve take a software renderer half a minute.
      if (std::string(name) == "curved/sheet" && std::string(stepping) == "adaptive_curves") continue;
      const Given few = {{"columns", int64_t{5}}, {"rows", int64_t{4}}};
      const scene::Scene scene = makeScene(name, std::string(name) == "curved/sheet" ? few : Given{});
      const Rendered made = render(scene, "isocurves/forward_differences",
                                   {{"stepping", std::string(stepping)}}, kIsocurvesSize, true);
      EXPECT_GT(made.counter("surface_px"), 500) << name;
      EXPECT_EQ(made.counter("hole_px"), 0) << name << " " << stepping;
      EXPECT_LT(made.counter("missed_px"), 0.01 * made.counter("surface_px")) << name << " " << stepping;
      EXPECT_LT(made.counter("wrong_place_px"), 0.05 * made.counter("surface_px")) << name << " " << stepping;
    }
}

TEST_F(Isocurves, AdaptiveStepsTakeFewerPoints) {
  const scene::Scene scene = makeScene("curved/teapot");
  const Rendered uniform = render(scene, "isocurves/forward_differences", {}, kIsocurvesSize, true);
  const Rendered adaptive = render(scene, "isocurves/forward_differences",
                                   {{"stepping", std::string("adaptive")}}, kIsocurvesSize, true);
  EXPECT_LT(adaptive.counter("points_per_px"), 0.9 * uniform.counter("points_per_px"));
}

// Of the teapot's patches, curved unevenly, parts need fewer points than the worst place asks of a whole
// patch.
TEST_F(Isocurves, PartsTakeFewerPoints) {
  const scene::Scene scene = makeScene("curved/teapot");
  const Rendered uniform = render(scene, "isocurves/forward_differences", {}, kIsocurvesSize, true);
  const Rendered hybrid = render(scene, "isocurves/forward_differences",
                                 {{"stepping", std::string("hybrid")}}, kIsocurvesSize, true);
  EXPECT_LT(hybrid.counter("points_per_px"), uniform.counter("points_per_px"));
  // 32 patches in 16 parts each, some of them outside or divided.
  EXPECT_GT(hybrid.counter("filled_parts"), 100);
}

// Differences over 64 steps of single precision: a hundredth of a pixel, whichever rectangle they start from.
TEST_F(Isocurves, DoNotDriftInParts) {
  const scene::Scene scene = makeScene("curved/teapot");
  for (const char* stepping : {"adaptive_curves", "hybrid"})
    EXPECT_LT(render(scene, "isocurves/forward_differences",
                     {{"stepping", std::string(stepping)}, {"check", false}}, kIsocurvesSize, true)
                  .counter("drift_px"),
              0.01)
        << stepping;
}

// A patch a thousand and more pixels across, of which 96 x 72 are seen: their 20 points a pixel each way are
// up to (96 x 20) x (72 x 20) / 64 = 43,200 of one group's invocations, in parts of which one may have them
// all, beside the points that are out of sight. No pixel stays empty, whatever rounds an invocation's loops
// may take.
TEST_F(Isocurves, LeaveNoHoleOfAPatchSeenClosely) {
  scene::Scene scene =
      makeScene("curved/sheet", {{"columns", int64_t{1}}, {"rows", int64_t{1}}, {"relief", 0.02}});
  scene::setStillCamera(scene,
                        {glm::dvec3(0.03, 0.09, 0.05), glm::dvec3(0.03, 0.0, 0.03), {0.0, 1.0, 0.0}, 40.0});
  const Rendered made =
      render(scene, "isocurves/forward_differences",
             {{"stepping", std::string("hybrid")}, {"spacing_px", 0.1}, {"restart", int64_t{4096}}},
             kIsocurvesSize, true);
  EXPECT_EQ(made.counter("surface_px"), 96 * 72);
  EXPECT_EQ(made.counter("hole_px"), 0);
}

// Four pixels apart, curves leave most pixels between them empty.
TEST_F(Isocurves, HolesAreCounted) {
  const scene::Scene scene = makeScene("curved/teapot");
  const Rendered coarse =
      render(scene, "isocurves/forward_differences", {{"spacing_px", 4.0}}, kIsocurvesSize, true);
  EXPECT_GT(coarse.counter("hole_px"), 0.1 * coarse.counter("surface_px"));
}

}  // namespace
}  // namespace limen::techniques
