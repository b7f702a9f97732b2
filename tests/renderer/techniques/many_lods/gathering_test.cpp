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

// One bounce, whose light the reference takes to the surfaces by virtual lights and rays, as a test of its
// own compares with paths: lit surfaces grow by a pixel like occluders, so that the picture's mean falls
// towards the reference's.
TEST_F(Gatherings, LightComesToThatOfVirtualLights) {
  const scene::Scene scene = makeScene("cornell_box");
  const Image truth =
      render(scene, "many_lods/traced_radiosity", {{"lights", int64_t{1024}}, {"clamp", 0.02}}, {16, 16})
          .product;
  double light = 0.0;
  for (const float value : truth.data) light += double(value);
  light = (light / double(truth.data.size()) * 4.0 - 1.0) / 3.0;  // less the alpha of 1
  double before = 1e9;
  for (const int64_t tile : {8, 16, 32}) {
    const Image found = render(scene, "many_lods/point_based", receivers(tile, 1), {16, 16}).product;
    const double error = meanDifference(found, truth);
    EXPECT_LT(error, before) << tile;
    before = error;
  }
  EXPECT_LT(before, 0.4 * light);
}

}  // namespace
}  // namespace limen::techniques
