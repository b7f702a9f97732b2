// SPDX-License-Identifier: BSD-3-Clause
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class ReflectionMapPictures : public TechniqueTest {
 protected:
  static Image maps(const scene::Scene& scene, int64_t tile, int64_t steps, const char* kind,
                    const char* discs = "oriented") {
    Given given = {{"tile", tile}, {"steps", steps}, {"maps", std::string(kind)}};
    if (std::string(kind) == "cuts") {
      given["maps.levels"] = int64_t{15};
      given["maps.discs"] = std::string(discs);
    }
    return render(scene, "many_lods/reflection_maps", given, {64, 48}).product;
  }
};

// One mirror in a room: rays that leave its surface meet what its map holds, once the map's depths say where.
// By their direction alone they miss by the mirror's radius, a third of the room's half. By depths they miss
// by a pixel of 0.02 to 0.03 radians, and from cuts by a node of two of them: a fifth of that at most. That
// falls with the resolution, from cuts as far as 32,768 points resolve, half as fine as these pixels. Lists
// have room for all points in both views, and pictures are so large that the mirror has hundreds of pixels.
TEST_F(ReflectionMapPictures, ComeToTracedRaysByDepthsAndResolution) {
  const glm::ivec2 sizePx(256, 192);
  const scene::Scene scene =
      makeScene("mirrors/crowd", {{"objects", int64_t{1}}, {"glass_every", int64_t{0}}});
  const Image truth = render(scene, "reflections/ray_traced", {{"bounces", int64_t{1}}}, sizePx).product;
  for (const char* kind : {"rays", "cuts"}) {
    const bool cuts = std::string(kind) == "cuts";
    const auto error = [&](int64_t tile, int64_t steps) {
      Given given = {{"tile", tile}, {"steps", steps}, {"maps", std::string(kind)}};
      if (cuts) {
        given["maps.levels"] = int64_t{15};
        given["maps.room"] = int64_t{32768};
      }
      const Rendered made = render(scene, "many_lods/reflection_maps", given, sizePx, true);
      if (cuts) {
        EXPECT_EQ(made.counter("refused_splits"), 0.0);
      }
      return meanDifference(made.product, truth);
    };
    const double fine = error(128, 4);
    EXPECT_LT(fine, 0.25 * error(128, 0)) << kind;
    EXPECT_LT(fine, 0.5 * error(16, 4)) << kind;
  }
}

// Maps of points against maps of triangles, of the same pixels: the pictures differ where outlines in maps
// shift by a pixel, for spheres by two.
TEST_F(ReflectionMapPictures, OfPointsAreThoseOfTriangles) {
  const scene::Scene scene =
      makeScene("mirrors/crowd", {{"objects", int64_t{8}}, {"glass_every", int64_t{3}}});
  const Image triangles = maps(scene, 64, 3, "rays");
  const Image without =
      render(scene, "many_lods/reflection_maps",
             {{"tile", int64_t{4}}, {"steps", int64_t{0}}, {"maps", std::string("rays")}}, {64, 48})
          .product;
  // Of the objects' light, whose size maps of 4 pixels have to a factor of two or so.
  const double light = meanDifference(triangles, without);
  ASSERT_GT(light, 0.0);
  EXPECT_LT(meanDifference(maps(scene, 64, 3, "cuts"), triangles), 0.5 * light);
  EXPECT_LT(meanDifference(maps(scene, 64, 3, "cuts", "spheres"), triangles), light);
}

// An object is not in its own map: with nothing else around, rays bring the background.
TEST_F(ReflectionMapPictures, LeaveTheirObjectOut) {
  scene::Scene scene = makeScene("mirrors/crowd", {{"objects", int64_t{1}}, {"glass_every", int64_t{0}}});
  const scene::Part object = scene.parts.back();
  scene.mesh.triangles.erase(scene.mesh.triangles.begin(),
                             scene.mesh.triangles.begin() + object.firstTriangle);
  scene.parts = {object};
  scene.parts[0].firstTriangle = 0;
  const Image truth = render(scene, "reflections/ray_traced", {{"bounces", int64_t{1}}}, {64, 48}).product;
  for (const char* kind : {"rays", "cuts"})
    EXPECT_LT(meanDifference(maps(scene, 32, 3, kind), truth), 1e-6) << kind;
}

}  // namespace
}  // namespace limen::techniques
