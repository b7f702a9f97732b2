// SPDX-License-Identifier: BSD-3-Clause
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class Gatherings : public TechniqueTest {
 protected:
  static double signedDifference(const Image& a, const Image& b) {
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) sum += double(a.at(x, y)) - double(b.at(x, y));
    return sum / (double(a.width) * a.height);
  }
  static double meanLight(const Image& picture) {
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        for (int c = 0; c < 3; ++c) sum += double(picture.at(x, y, c));
    return sum / (3.0 * picture.width * picture.height);
  }
  static Given receivers(int64_t tile, int64_t spacing) {
    return {{"levels", int64_t{14}},
            {"tile", tile},
            {"epsilon", 2.0},
            {"room", int64_t{4096}},
            {"spacing", spacing}};
  }
};

// Discs are spheres' outlines and at least a pixel, so that occluders grow by up to a pixel all around and
// corners darken: by an error that falls with the size of pixels, a half for each doubling of the tile's
// side, as the measure of a border does. A third more is allowed. Rays: 256 a pixel, 3 % each, a thousandth
// over the picture.
TEST_F(Gatherings, OcclusionComesToThatOfRays) {
  const scene::Scene scene = makeScene("cornell_box");
  const Image truth = render(scene, "ambient_occlusion/ray_traced", {{"radius", 1.0}}, {24, 24}).product;
  double before = -1.0;
  for (const int64_t tile : {8, 16, 32}) {
    const double error = signedDifference(
        render(scene, "many_lods/ambient_occlusion", receivers(tile, 1), {24, 24}).product, truth);
    EXPECT_LT(std::abs(error), 0.67 * std::abs(before)) << tile;
    before = error;
  }
  EXPECT_LT(std::abs(before), 0.04);
}

// Over an open floor nothing occludes, whatever the filter: all receivers see the same, and the points of
// their own plane stay below the horizon but for what spheres rise above it, less than a hundredth (a pixel
// of 16 at the rim, where the cosine is a twentieth, of 200).
TEST_F(Gatherings, AnOpenFloorIsNotOccluded) {
  scene::Scene scene = makeScene("half_plane");
  for (const int64_t spacing : {1, 3}) {
    Given given = receivers(16, spacing);
    given["radius"] = 0.02;
    const Image found = render(scene, "many_lods/ambient_occlusion", given, {20, 15}).product;
    const Image truth = render(scene, "ambient_occlusion/ray_traced", {{"radius", 0.02}}, {20, 15}).product;
    EXPECT_NEAR(signedDifference(found, truth), 0.0, 0.03) << spacing;
  }
}

// One bounce against rays that know neither points nor virtual lights (ray_gathered, which a test of its own
// compares with double precision). A pixel of a tile is 2 / 32 rad wide, and light at a receiver changes by
// about its own size over the room: the mean of the differences is below the width of two pixels, an eighth,
// and halves, up to the reference's noise (3 % of a pixel's light), as tiles' sides double. Energy: what
// outlines lose or gain is of either sign, so that it keeps to a few percent.
TEST_F(Gatherings, LightComesToThatOfRays) {
  const scene::Scene scene = makeScene("cornell_box");
  for (const double gloss : {0.0, 0.5}) {
    const Given surface = {{"receivers.share", gloss}, {"receivers.exponent", 10.0}};
    Given rays = surface;
    rays["rays"] = int64_t{1024};
    const Image truth = render(scene, "many_lods/ray_gathered", rays, {16, 16}).product;
    const double light = meanLight(truth);
    double before = 1e9;
    for (const int64_t tile : {8, 16, 32}) {
      Given given = receivers(tile, 1);
      given.insert(surface.begin(), surface.end());
      const Image found = render(scene, "many_lods/point_based", given, {16, 16}).product;
      const double error = meanDifference(found, truth);
      EXPECT_LT(error, 0.75 * before) << tile;
      before = error;
      if (tile == 32) {
        EXPECT_NEAR(meanLight(found), light, 0.03 * light) << gloss;
      }
    }
    EXPECT_LT(before, 0.125 * light) << gloss;
  }
}

// A half-plane between lamp and floor is lit from above alone, and the floor beneath sees its dark side: no
// light comes to what the camera sees. If both sides were lit, the floor would receive a part of what the
// lamp makes of the half-plane, whose radiance is the unit here.
TEST_F(Gatherings, TheBackOfALitSurfaceIsDark) {
  const scene::Scene scene = makeScene("half_plane");
  const scene::AreaLight& light = scene.lights[0];
  const double above = light.centre.y - scene.casterBounds().high.y;
  const double lit =
      10.0 * light.area() * double(light.parts[0].radiance.x) * 0.7 / (std::acos(-1.0) * above * above);
  for (const char* discs : {"oriented", "spheres"}) {
    Given given = receivers(16, 1);
    given["discs"] = std::string(discs);
    EXPECT_LT(meanLight(render(scene, "many_lods/point_based", given, {20, 15}).product), 0.01 * lit)
        << discs;
  }
  EXPECT_LT(meanLight(render(scene, "many_lods/ray_gathered", {{"rays", int64_t{64}}}, {20, 15}).product),
            0.01 * lit);
}

// Probes: nine terms of the irradiance are within a few percent of all (Ramamoorthi and Hanrahan 2001), and
// what is left is light that changes between probes. It falls as they come closer. On average it keeps the
// energy to a tenth.
TEST_F(Gatherings, LightOfProbesComesToThatOfRaysAsTheyGrowDenser) {
  const scene::Scene scene = makeScene("cornell_box");
  const Image truth = render(scene, "many_lods/ray_gathered", {{"rays", int64_t{512}}}, {24, 24}).product;
  double before = 1e9;
  for (const int64_t probes : {2, 5, 12}) {
    const Image found =
        render(scene, "many_lods/irradiance_volume",
               {{"levels", int64_t{13}}, {"room", int64_t{1024}}, {"probes", probes}, {"tile", int64_t{16}}},
               {24, 24})
            .product;
    const double error = meanDifference(found, truth);
    EXPECT_LT(error, before) << probes;
    before = error;
    if (probes == 12) {
      EXPECT_NEAR(meanLight(found), meanLight(truth), 0.1 * meanLight(truth));
    }
  }
  EXPECT_LT(before, 0.3 * meanLight(truth));
}

}  // namespace
}  // namespace limen::techniques
