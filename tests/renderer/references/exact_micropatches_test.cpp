// SPDX-License-Identifier: BSD-3-Clause
// The exact union of micropatches against closed forms of cards whose edges fall on edges of texels.
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/references/render_reference.h"

namespace limen::references {
namespace {

constexpr double kPatchLightHeight = 2.0;

/// A level card over [low, high] in world x and z.
struct LevelCard {
  glm::dvec2 low, high;
  double height;
};

/// Cards over a ground that leans by `tilt` degrees about z, under a light of side `lightSize` that looks
/// straight down.
scene::Scene cardsOverGround(const std::vector<LevelCard>& cards, double lightSize, double tilt = 0.0) {
  scene::Scene scene;
  const double radians = glm::radians(tilt);
  scene::addPart(
      scene, "ground",
      scene::card({0.0, 0.0, 0.0}, {0.0, 0.0, 4.0}, {4.0 * std::cos(radians), 4.0 * std::sin(radians), 0.0}),
      glm::vec3(0.7F), scene::Role::ReceiverOnly);
  for (const LevelCard& card : cards) {
    const glm::dvec2 centre = 0.5 * (card.low + card.high), half = 0.5 * (card.high - card.low);
    scene::addPart(scene, "card",
                   scene::card({centre.x, card.height, centre.y}, {0.0, 0.0, half.y}, {half.x, 0.0, 0.0}),
                   glm::vec3(0.5F));
  }
  scene.lights = {scene::lightTowards({0.0, kPatchLightHeight, 0.0}, glm::dvec3(0.0), glm::dvec2(lightSize))};
  scene::setStillCamera(scene, scene::orbitCamera({0.0, 0.0, 0.0}, 4.0, 20.0, 40.0));
  return scene;
}

/// Rectangle of the light, in unit coordinates within [0, 1]^2, that a card hides from p (light space).
std::pair<glm::dvec2, glm::dvec2> hiddenBy(const LevelCard& card, const scene::AreaLight& light,
                                           glm::dvec3 p) {
  const double z = kPatchLightHeight - card.height;
  if (p.z <= z) return {glm::dvec2(0.0), glm::dvec2(0.0)};
  glm::dvec2 low(1.0), high(0.0);
  for (const glm::dvec2 corner : {card.low, card.high}) {
    const glm::dvec3 world(corner.x, card.height, corner.y);
    const glm::dvec3 q(light.toLightSpace() * glm::dvec4(world, 1.0));
    const glm::dvec2 s =
        (glm::dvec2(p) + (glm::dvec2(q) - glm::dvec2(p)) * (p.z / (p.z - z))) / light.size + 0.5;
    low = glm::min(low, s), high = glm::max(high, s);
  }
  return {glm::clamp(low, 0.0, 1.0), glm::clamp(high, 0.0, 1.0)};
}

double areaOf(glm::dvec2 low, glm::dvec2 high) {
  return std::max(0.0, high.x - low.x) * std::max(0.0, high.y - low.y);
}

class ExactMicropatches : public gl::GlTest {
 protected:
  /// Calls check(visibility, point) for receivers that are not on a card.
  template <class Check>
  static void forGround(const scene::Scene& scene, const Given& given, const Check& check) {
    const Rendered rendered =
        renderReference(context(), scene, "soft_shadows/exact_micropatches", given, {48, 36});
    const glm::dmat4 toWorld = glm::inverse(scene.lights[0].toLightSpace());
    const Bounds cards(scene);
    size_t partial = 0;
    for (size_t i = 0; i < rendered.visibility.pixels(); ++i) {
      if (!rendered.isReceiver(i)) continue;
      const glm::dvec3 world(toWorld * glm::dvec4(rendered.point(i), 1.0));
      if (cards.holds(world)) continue;
      check(double(rendered.visibility.data[i]), rendered.point(i));
      partial += rendered.visibility.data[i] > 0.0F && rendered.visibility.data[i] < 1.0F;
    }
    EXPECT_GE(partial, 50U) << "the picture shows too little of the penumbra";
  }

 private:
  struct Bounds {
    explicit Bounds(const scene::Scene& scene) {
      for (const scene::Part& part : scene.parts)
        if (!part.receiverOnly)
          heights.push_back(scene.mesh.positions[scene.mesh.triangles[part.firstTriangle].x].y);
    }
    bool holds(glm::dvec3 world) const {
      for (const double height : heights)
        if (std::abs(world.y - height) < 1e-5) return true;
      return false;
    }
    std::vector<double> heights;
  };
};

// The frustum's margin is one texel, so that the edges of the only card are edges of texels. Its depth z in
// the map is rounded to float twice (as near / z, and back), by 2^-24 each: an edge on the light moves by at
// most |q - p| p_z / (p_z - z)^2 dz / w. On the ground p_z < 2.4, |q - p| < 1.2, p_z - z > 0.6 and z = w = 1:
// 8 * 2^-23 = 1e-6, and mean roundings lie well below that.
TEST_F(ExactMicropatches, OfACardOnTexelEdgesIsItsClosedForm) {
  const LevelCard card{{-0.5, -0.25}, {0.5, 0.25}, 1.0};
  for (const double tilt : {0.0, 20.0}) {
    const scene::Scene scene = cardsOverGround({card}, 1.0, tilt);
    for (const std::string bias : {"receiver_plane", "receiver_slope", "constant"}) {
      // Beside the card the map sees the ground, which shadows itself where it leans and no bias follows it.
      if (tilt != 0.0 && bias == "constant") continue;
      double largest = 0.0;
      forGround(scene, {{"resolution", int64_t{64}}, {"bias", bias}}, [&](double visibility, glm::dvec3 p) {
        const auto [low, high] = hiddenBy(card, scene.lights[0], p);
        largest = std::max(largest, std::abs(visibility - (1.0 - areaOf(low, high))));
      });
      EXPECT_LE(largest, 1e-6) << bias << ' ' << tilt;
    }
  }
}

// Two cards side by side for the map, in tangents [-0.31, -0.01] and [0, 0.31]: with a margin of one texel, a
// map of 64 has 62 texels of 0.01 between. Neither hides the other from the map; from beside they overlap on
// the light. |A u B| = |A| + |B| - |A n B|.
TEST_F(ExactMicropatches, CountsWhatTwoCardsHideOnce) {
  const double zA = 0.8, zB = 1.6;
  const LevelCard a{{-0.31 * zA, -0.31 * zA}, {-0.01 * zA, 0.31 * zA}, kPatchLightHeight - zA};
  const LevelCard b{{0.0, -0.31 * zB}, {0.31 * zB, 0.31 * zB}, kPatchLightHeight - zB};
  const scene::Scene scene = cardsOverGround({a, b}, 1.0);
  int overlapping = 0;
  forGround(scene, {{"resolution", int64_t{64}}, {"bias", std::string("constant")}},
            [&](double visibility, glm::dvec3 p) {
              const auto [lowA, highA] = hiddenBy(a, scene.lights[0], p);
              const auto [lowB, highB] = hiddenBy(b, scene.lights[0], p);
              const double both = areaOf(glm::max(lowA, lowB), glm::min(highA, highB));
              overlapping += both > 0.02;
              // p_z / (p_z - z) is 5 for the lower card.
              EXPECT_NEAR(visibility, 1.0 - (areaOf(lowA, highA) + areaOf(lowB, highB) - both), 1e-5);
            });
  EXPECT_GT(overlapping, 50);
}

// A plane x = y / 8 stands nearly upright under a light that reaches behind it, and nothing else: seen is
// what lies before it, as in the exact union of triangles.
TEST_F(ExactMicropatches, HidesTheLightBehindTheReceiversPlane) {
  scene::Scene scene;
  scene::addPart(scene, "sheet", scene::card({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0625, 0.5, 0.0}),
                 glm::vec3(0.7F));
  scene.lights = {scene::lightTowards({0.5, 2.0, 0.0}, {0.5, 0.0, 0.0}, {4.0, 4.0})};
  scene::setStillCamera(scene, {{3.0, 0.5, 0.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 30.0});
  // It meets the light, [-3/2, 5/2] wide, at x = 1/4.
  constexpr double kSeenShare = (2.5 - 0.25) / 4.0;
  const Rendered rendered = renderReference(context(), scene, "soft_shadows/exact_micropatches",
                                            {{"resolution", int64_t{64}}}, {32, 32});
  EXPECT_GT(rendered.receiverCount(), 50U);
  for (size_t i = 0; i < rendered.visibility.pixels(); ++i)
    EXPECT_NEAR(rendered.visibility.data[i], rendered.isReceiver(i) ? kSeenShare : 1.0, 1e-6);
}

TEST_F(ExactMicropatches, StretchingAndCoarserLevelsOnlyDarken) {
  const scene::Scene scene = builtScene("sphere_grid");
  const auto visibility = [&](const char* fill, int64_t level) {
    return renderReference(context(), scene, "soft_shadows/exact_micropatches",
                           {{"resolution", int64_t{64}},
                            {"gap_fill", std::string(fill)},
                            {"level", level},
                            {"bias", std::string("constant")}},
                           {32, 24})
        .visibility.data;
  };
  const std::vector<float> none = visibility("none", 0), sides = visibility("left_bottom", 0),
                           corners = visibility("diagonal", 0), coarse = visibility("none", 2);
  double filled = 0.0;
  for (size_t i = 0; i < none.size(); ++i) {
    EXPECT_LE(sides[i], none[i]);
    EXPECT_LE(corners[i], sides[i]);
    // A coarse patch covers its four by four texels at the nearest of their depths; where the ground falls
    // away from it their own projections may reach farther, so that this holds on average only.
    filled += none[i] - sides[i];
  }
  EXPECT_GT(filled, 0.0);
  double mean = 0.0, meanCoarse = 0.0;
  for (size_t i = 0; i < none.size(); ++i) mean += none[i], meanCoarse += coarse[i];
  EXPECT_LT(meanCoarse, mean);
}

TEST_F(ExactMicropatches, LevelsThatAMapDoesNotHaveAreRefused) {
  try {
    renderReference(context(), builtScene("two_boxes"), "soft_shadows/exact_micropatches",
                    {{"resolution", int64_t{64}}, {"level", int64_t{7}}}, {8, 8});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "level");
  }
}

}  // namespace
}  // namespace limen::references
