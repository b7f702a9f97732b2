// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/ray_casting/view_rays.h"

#include "renderer/surfaces/bezier.h"
#include "renderer/techniques/tessellation/surface_view.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class RayCasting : public TechniqueTest {};

constexpr glm::ivec2 kSize{96, 72};

// Three root finders that share nothing but the ray.
TEST_F(RayCasting, ExactMethodsShowTheSame) {
  for (const char* name : {"curved/teapot", "curved/double_torus"}) {
    const scene::Scene scene = makeScene(name);
    const Rendered clips = render(scene, "ray_casting/exact", {{"check", true}}, kSize, true);
    EXPECT_GT(clips.counter("surface_px"), 500) << name;
    for (const char* error : {"missed_px", "hole_px", "false_px", "wrong_place_px"})
      EXPECT_EQ(clips.counter(error), 0) << name << " " << error;
    for (const char* roots : {"hull_subdivision", "interval_arithmetic"}) {
      const Rendered other = render(scene, "ray_casting/exact", {{"roots", std::string(roots)}}, kSize, true);
      EXPECT_EQ(clips.counter("surface_px"), other.counter("surface_px")) << name << " " << roots;
      EXPECT_LT(meanDifference(clips.product, other.product), 1e-5) << name << " " << roots;
    }
  }
}

// A fine tessellation is another picture of the same surface: they differ at silhouettes alone.
TEST_F(RayCasting, ExactRaysShowWhatAFineTessellationShows) {
  for (const char* name : {"curved/teapot", "curved/double_torus"}) {
    const scene::Scene scene = makeScene(name);
    const Rendered rays = render(scene, "ray_casting/exact", {}, kSize);
    const Rendered fine =
        render(scene, "tessellation/uniform_fine",
               {{"segments", int64_t{std::string(name) == "curved/teapot" ? 64 : 16}}}, kSize);
    EXPECT_LT(meanDifference(rays.product, fine.product), 1e-3) << name;
  }
}

TEST_F(RayCasting, PrismsShowWhatExactRaysShow) {
  const scene::Scene scene = makeScene("curved/double_torus");
  const Rendered exact = render(scene, "ray_casting/exact", {}, kSize, true);
  for (const int64_t subPrisms : {1, 4, 16})
    for (const char* sides : {"back", "front"}) {
      const Rendered prisms = render(scene, "ray_casting/pn_prisms",
                                     {{"sub_prisms", subPrisms}, {"sides", std::string(sides)}}, kSize, true);
      EXPECT_EQ(prisms.counter("prisms"), 1536 * subPrisms);
      EXPECT_EQ(prisms.counter("surface_px"), exact.counter("surface_px"));
      EXPECT_EQ(prisms.counter("hole_px"), 0) << subPrisms << sides;
      EXPECT_LE(prisms.counter("missed_px") + prisms.counter("false_px"), 3) << subPrisms << sides;
      EXPECT_LE(prisms.counter("wrong_place_px"), 3) << subPrisms << sides;
      EXPECT_LT(meanDifference(exact.product, prisms.product), 1e-3) << subPrisms << sides;
    }
}

// Where the surface only comes near the ray, Newton's method must not count as a hit. With a quarter of a
// pixel as the tolerance it does, all around the silhouette.
TEST_F(RayCasting, PrismsEndAtTheSilhouette) {
  const scene::Scene scene = makeScene("curved/double_torus");
  const Rendered fine = render(scene, "ray_casting/pn_prisms", {}, {320, 240}, true);
  EXPECT_LE(fine.counter("false_px"), 3);
  EXPECT_EQ(fine.counter("missed_px"), 0);
  const Rendered coarse = render(scene, "ray_casting/pn_prisms", {{"tolerance_px", 0.25}}, {320, 240}, true);
  EXPECT_GT(coarse.counter("false_px"), 100);
}

// The comparison itself finds what is wrong: with no Newton step, hardly anything is hit.
TEST_F(RayCasting, MissedPixelsAreCounted) {
  const scene::Scene scene = makeScene("curved/double_torus");
  const Rendered few =
      render(scene, "ray_casting/pn_prisms", {{"steps", int64_t{1}}, {"tolerance_px", 0.001}}, kSize, true);
  EXPECT_GT(few.counter("missed_px"), 0.05 * few.counter("surface_px"));
  EXPECT_GT(few.counter("hole_px"), 0);
}

TEST_F(RayCasting, FoundPlacesLieOnTheSurfaceAndTheRay) {
  const scene::Scene scene = makeScene("curved/double_torus");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, kSize);
  const surfaces::SurfaceView view = viewOf(frame);
  const ExactView exact = exactView(scene.surfaces, surfaces::RootFinder::Clipping, view, kSize, 1e-4);
  int hits = 0;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      const ExactPixel& pixel = exact.at(x, y);
      if (!pixel.hit) continue;
      ++hits;
      const surfaces::Patch& patch = scene.surfaces.patches[pixel.at.patch];
      const glm::dvec3 p =
          surfaces::evaluate(scene.surfaces, patch, pixel.at.at, surfaces::Order::Position).p - view.eye;
      const double distance = glm::dot(p, view.forward);
      EXPECT_NEAR(distance, pixel.distance, 1e-5);
      // Pixel that the point projects to.
      EXPECT_NEAR((glm::dot(p, view.right) / distance / view.tanHalf.x + 1.0) * 0.5 * kSize.x - 0.5, x, 1e-3);
      EXPECT_NEAR((1.0 - glm::dot(p, view.up) / distance / view.tanHalf.y) * 0.5 * kSize.y - 0.5, y, 1e-3);
    }
  EXPECT_GT(hits, 500);
}

// Closed formulas, intervals and Bernstein form see what intervals in double see.
TEST_F(RayCasting, AlgebraicSurfacesAreHitWhereExactRaysHitThem) {
  const scene::Scene scene = makeScene("half_plane");
  for (const char* surface : {"sphere", "hyperboloid", "torus", "goursat", "heart", "barth_decic"})
    for (const char* roots : {"bernstein", "intervals", "closed_formula"}) {
      const Given given = {{"surface", std::string(surface)}, {"roots", std::string(roots)}};
      const bool high = std::string(surface) == "heart" || std::string(surface) == "barth_decic";
      if (high && std::string(roots) == "closed_formula") {
        EXPECT_TRUE(refusal("ray_casting/algebraic", given).has_value());
        continue;
      }
      const Rendered made = render(scene, "ray_casting/algebraic", given, kSize, true);
      EXPECT_GT(made.counter("surface_px"), 500) << surface;
      const double most = 0.01 * made.counter("surface_px");
      // A formula of degree 4 in float now and then misses a root, as its authors found.
      const bool quartic = std::string(roots) == "closed_formula" && std::string(surface) != "sphere";
      EXPECT_LE(made.counter("hole_px"), quartic ? 5 : 0) << surface << " " << roots;
      EXPECT_LE(made.counter("missed_px"), quartic ? most : 0) << surface << " " << roots;
      EXPECT_LE(made.counter("wrong_place_px"), most) << surface << " " << roots;
      EXPECT_LE(made.counter("false_px"), 2.0 * most) << surface << " " << roots;
    }
}

TEST_F(RayCasting, PatchesOtherThanTrianglesAreRefused) {
  const scene::Scene scene = makeScene("curved/teapot");
  EXPECT_THROW(render(scene, "ray_casting/pn_prisms", {}, kSize), Error);
}

}  // namespace
}  // namespace limen::techniques
