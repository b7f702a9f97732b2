// SPDX-License-Identifier: BSD-3-Clause
// Scattering: against a closed form, the same bytes again, and the wrong answers that the thesis shows.
#include <algorithm>
#include <cmath>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class ScatterTest : public TechniqueTest {
 protected:
  /// World position of a pixel on the ground; false if it shows something else.
  static bool groundPoint(const scene::Scene& scene, const Rendered& rendered, size_t pixel, glm::dvec3& at) {
    const float* receiver = rendered.receivers.data.data() + 4 * pixel;
    if (receiver[3] < 0.0F) return false;
    at =
        glm::inverse(scene.lights[0].toLightSpace()) * glm::dvec4(receiver[0], receiver[1], receiver[2], 1.0);
    return at.y < 0.01;
  }

  static Given maps(const std::string& layers) {
    return {{"resolution", int64_t{64}}, {"soft_resolution", int64_t{64}}, {"layers", layers}};
  }
};

TEST_F(ScatterTest, FlatRectangleIsTheClosedForm) {
  // The map of casters is fitted to the rectangle with a margin of one texel, so its texels' edges are the
  // rectangle's, and the light that it hides at height h from a light at H over the ground is the overlap of
  // two intervals on either axis, piecewise linear in the ground's coordinates with slopes (H / h - 1) / w.
  // Interpolation between texels of the soft shadow map errs where the slope jumps: by the jump times a
  // quarter of a texel on either axis.
  constexpr double kHeight = 0.7, kLight = 2.0, kK = kLight / kHeight;
  constexpr int kSoft = 256;
  const scene::Scene scene = makeScene("parallel_rectangle", {{"height", kHeight}});
  Given given = maps("nearest");
  given["soft_resolution"] = int64_t{kSoft};
  const Rendered rendered = render(scene, "soft_shadows/scatter", given, {64, 48}, true);
  const glm::dvec2 w = scene.lights[0].size, half(0.3, 0.2);
  const bool alongX = std::abs(scene.lights[0].axisX.x) > 0.5;
  // The map's side on the ground: the rectangle seen from the light's centre, a texel more to either side,
  // and the penumbra.
  const glm::dvec2 light = alongX ? w : glm::dvec2(w.y, w.x);
  const glm::dvec2 side =
      2.0 * (half * 64.0 / 62.0 * kLight / (kLight - kHeight) + 0.5 * light * kHeight / (kLight - kHeight));
  const glm::dvec2 kink = (kK - 1.0) / light * side / double(kSoft) / 4.0;
  int partly = 0;
  for (size_t i = 0; i < rendered.product.pixels(); ++i) {
    glm::dvec3 at;
    if (!groundPoint(scene, rendered, i, at)) continue;
    const auto hidden = [&](double x, double halfSize, double width) {
      const double low = x + (-halfSize - x) * kK, high = x + (halfSize - x) * kK;
      return std::max(0.0, std::min(high, 0.5 * width) - std::max(low, -0.5 * width)) / width;
    };
    const double expected = 1.0 - hidden(at.x, half.x, light.x) * hidden(at.z, half.y, light.y);
    partly += expected > 0.0 && expected < 1.0;
    // Beside that: 62 x 62 shares rounded to 2^-22, and float positions.
    ASSERT_NEAR(rendered.product.data[i], expected, kink.x + kink.y + 2e-3) << at.x << " " << at.z;
  }
  EXPECT_GT(partly, 200);
  EXPECT_EQ(rendered.counter("caster_texels"), 62.0 * 62.0);
}

TEST_F(ScatterTest, GivesTheSameBytesAgain) {
  const scene::Scene scene = makeScene("two_boxes");
  for (const char* layers : {"nearest", "front_and_back"}) {
    const Rendered first = render(scene, "soft_shadows/scatter", maps(layers), {48, 36});
    const Rendered again = render(scene, "soft_shadows/scatter", maps(layers), {48, 36});
    EXPECT_EQ(first.product.data, again.product.data);
  }
}

TEST_F(ScatterTest, LosesTheUmbraOfOneLayerAndOverstatesThatOfTwo) {
  // Fig. 4.3. The box spans 1 x 1 m from 0.8 to 2 m, the light 2 x 2 m at 3.2 m. From the ground at (x, 0)
  // the underside reaches on the light from x - 4 (0.5 + x) to x + 4 (0.5 - x): all of it while |x| < 1/3.
  // The top, all that the light's centre sees, reaches from x - 1.6 (0.5 + x) to x + 1.6 (0.5 - x): 1.6 of 2
  // m on either axis, and 0.36 of the light stays.
  const Given box = {{"clearance", 0.8}, {"box_height", 1.2}};
  const scene::Scene scene = makeScene("box_under_light", box);
  const glm::ivec2 sizePx(64, 48);
  const Rendered truth = render(scene, "soft_shadows/exact_union", {}, sizePx);
  const Rendered triangles = render(scene, "soft_shadows/triangle_bitmask", {}, sizePx);
  const Rendered nearest = render(scene, "soft_shadows/scatter", maps("nearest"), sizePx);
  const Rendered both = render(scene, "soft_shadows/scatter", maps("front_and_back"), sizePx);
  int umbra = 0;
  double darker = 0.0;
  for (size_t i = 0; i < truth.product.pixels(); ++i) {
    glm::dvec3 at;
    if (!groundPoint(scene, truth, i, at)) continue;
    darker = std::max(darker, double(truth.product.data[i] - both.product.data[i]));
    if (std::max(std::abs(at.x), std::abs(at.z)) > 0.3) continue;
    ++umbra;
    EXPECT_EQ(truth.product.data[i], 0.0F);
    EXPECT_EQ(triangles.product.data[i], 0.0F);
    // A soft shadow map of 64 texels over less than 8 m: positions within 0.13 m, and 0.3 of the light a
    // metre.
    EXPECT_NEAR(nearest.product.data[i], 0.36, 0.04);
  }
  EXPECT_GT(umbra, 10);
  // Two sides of the box, which the larger sum counts beside what hides them, cover 0.115 of the light from
  // (0.8, 0): the trapezium between z = 0.8 and 1 on the light, x from -1 to 0.15 on average, twice.
  EXPECT_GT(darker, 0.1);

  // Fig. 4.3 e: top and underside alone. From (0.62, 0) the top hides 0.8 of the light's width over 0.714 of
  // its length, the underside all of its width over 0.57: 0.571 each, and 0.685 together.
  Given plates = box;
  plates["sides"] = false;
  const scene::Scene two = makeScene("box_under_light", plates);
  const Rendered flat = render(two, "soft_shadows/exact_union", {}, sizePx);
  const Rendered larger = render(two, "soft_shadows/scatter", maps("front_and_back"), sizePx);
  double lighter = 0.0;
  darker = 0.0;
  for (size_t i = 0; i < flat.product.pixels(); ++i) {
    glm::dvec3 at;
    if (!groundPoint(two, flat, i, at)) continue;
    lighter = std::max(lighter, double(larger.product.data[i] - flat.product.data[i]));
    darker = std::max(darker, double(flat.product.data[i] - larger.product.data[i]));
  }
  // The peak falls by less than 1 a metre, and pixels are 0.06 m apart.
  EXPECT_GT(lighter, 0.114 - 0.045);
  // The larger of two parts never hides more than both, but for the interpolation: a quarter of a texel of
  // 0.13 m times a jump of slope of 1.5 on the way from lit to umbra, on either axis.
  EXPECT_LT(darker, 2.0 * 0.25 * 0.13 * 1.5);
}

}  // namespace
}  // namespace limen::techniques
