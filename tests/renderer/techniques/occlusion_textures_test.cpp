// SPDX-License-Identifier: BSD-3-Clause
// Occlusion textures where they are exact, and where they are known to fail.
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class OcclusionTexturesTest : public TechniqueTest {
 protected:
  static scene::Mesh flat(double height, double half, double x = 0.0) {
    return scene::card({x, height, 0.0}, {0.0, 0.0, half}, {half, 0.0, 0.0});
  }
};

TEST_F(OcclusionTexturesTest, OnePlaneIsExact) {
  // All slices lie between the map's near plane and the card, a thousandth of its depth apart, and the card
  // is in the last. Its plane is 1e-5 of its depth off, and so is the cone's cut: less than 1e-4 of its
  // extents. The card's edges fall on edges of texels, whole numbers add up exactly, and the reference has
  // rounding of its own.
  const scene::Scene scene = makeScene("parallel_rectangle");
  const Rendered exact = render(scene, "soft_shadows/exact_union", {}, {64, 48});
  for (const int64_t slices : {1, 4, 32}) {
    const Rendered rendered = render(scene, "soft_shadows/occlusion_textures",
                                     {{"resolution", int64_t{128}}, {"slices", slices}}, {64, 48});
    int penumbra = 0;
    for (size_t i = 0; i < rendered.product.pixels(); ++i) {
      ASSERT_NEAR(rendered.product.data[i], exact.product.data[i], 1e-3) << i;
      penumbra += exact.product.data[i] > 0.0F && exact.product.data[i] < 1.0F ? 1 : 0;
    }
    EXPECT_GT(penumbra, 200);
  }
}

TEST_F(OcclusionTexturesTest, WhatBlocksWithinTheReceiversSliceIsMissed) {
  // A small card 0.12 above a wide one, and a third, high up and aside, that widens the range of depths to
  // 0.3 .. 1.5. In four slices of 0.3 both cards lie in the last one; in 32 of 0.0375 they lie apart.
  scene::Scene scene;
  scene::addGround(scene, 8.0);
  scene::addPart(scene, "wide", flat(0.5, 0.6), {0.6F, 0.6F, 0.6F});
  scene::addPart(scene, "small", flat(0.62, 0.25), {0.6F, 0.4F, 0.4F});
  scene::addPart(scene, "aside", flat(1.7, 0.02, -0.2), {0.4F, 0.4F, 0.6F});
  scene.lights = {scene::lightTowards({0.0, 2.0, 0.0}, glm::dvec3(0.0), glm::dvec2(0.1))};
  scene::setStillCamera(scene, scene::orbitCamera({0.0, 0.5, 0.0}, 3.0, 20.0, 37.0));
  const Rendered exact = render(scene, "soft_shadows/exact_union", {}, {96, 72});
  std::map<int64_t, Rendered> made;
  for (const int64_t slices : {4, 32})
    made[slices] = render(scene, "soft_shadows/occlusion_textures", {{"slices", slices}}, {96, 72});
  int umbra = 0;
  for (size_t i = 0; i < exact.product.pixels(); ++i) {
    const float *receiver = &exact.receivers.data[4 * i], value = exact.product.data[i];
    // The wide card's top, in the small card's umbra.
    if (receiver[3] < 0.0F || std::abs(receiver[2] - 1.5F) > 0.001F || value > 0.0F) continue;
    if (std::max(std::abs(receiver[0]), std::abs(receiver[1])) > 0.26F) continue;
    ++umbra;
    EXPECT_EQ(made[4].product.data[i], 1.0F);
    EXPECT_LT(made[32].product.data[i], 1e-4F);
  }
  EXPECT_GT(umbra, 50);
}

TEST_F(OcclusionTexturesTest, SlicesAreTakenToBlockIndependently) {
  // Of cards in the umbra of the topmost none takes more light away: exact visibility is one card's. The
  // product multiplies what each leaves open, and darkens the penumbra; with the independence it assumes, two
  // cards of half coverage leave a quarter.
  double one = 0.0, eight = 0.0;
  for (const int64_t cards : {1, 8}) {
    const scene::Scene scene =
        makeScene("card_stack", {{"cards", cards}, {"spacing", 0.1}, {"fit", std::string("umbra")}});
    const Rendered rendered = render(scene, "soft_shadows/occlusion_textures", {}, {64, 48}),
                   exact = render(scene, "soft_shadows/exact_union", {}, {64, 48});
    for (size_t i = 0; i < rendered.product.pixels(); ++i) {
      // The ground: of the cards' tops the camera sees some.
      if (rendered.receivers.data[4 * i + 3] < 0.0F || rendered.receivers.data[4 * i + 2] < 1.99F) continue;
      const double error = double(rendered.product.data[i]) - exact.product.data[i];
      (cards == 1 ? one : eight) += error;
      // Never brighter than the topmost card alone leaves it: its plane is the first slice's, 0.75 / 16 of
      // depth below it at most, which narrows its shadow's penumbra by 0.3 * 0.047 / 0.8 * 2 / 0.8 ... of the
      // light: a tenth.
      EXPECT_LT(error, 0.1);
    }
  }
  EXPECT_LT(eight, one - 5.0);
}

}  // namespace
}  // namespace limen::techniques
