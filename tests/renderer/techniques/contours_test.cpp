// SPDX-License-Identifier: BSD-3-Clause
// Occluder contours against closed forms of flat cards, and the two failures that Schwarz 2009, Fig. 4.23,
// shows.
#include <algorithm>
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr double kLightHeight = 2.0, kLightSize = 0.4;
constexpr int kContourMapSize = 64;

/// A level card over [low, high] in world x and z.
struct Card {
  glm::dvec2 low, high;
  double height = 0.7;
};

class Contours : public TechniqueTest {
 protected:
  static scene::Scene sceneOf(const std::vector<Card>& cards) {
    scene::Scene scene;
    scene::addGround(scene, 8.0);
    for (const Card& card : cards) {
      const glm::dvec2 centre = 0.5 * (card.low + card.high), half = 0.5 * (card.high - card.low);
      scene::addPart(scene, "card",
                     scene::card({centre.x, card.height, centre.y}, {0.0, 0.0, half.y}, {half.x, 0.0, 0.0}),
                     {0.5F, 0.5F, 0.5F});
    }
    scene.lights = {scene::lightTowards({0.0, kLightHeight, 0.0}, glm::dvec3(0.0), glm::dvec2(kLightSize))};
    scene::setStillCamera(scene, scene::orbitCamera({0.0, 0.0, 0.0}, 3.4, 20.0, 40.0));
    return scene;
  }

  static Rendered shadows(const scene::Scene& scene, Given given) {
    given["resolution"] = int64_t{kContourMapSize};
    given["budget.limit"] = int64_t{0};
    return render(scene, "soft_shadows/backprojection", given, {64, 48});
  }

  static Rendered contours(const scene::Scene& scene, double inset) {
    return shadows(scene, {{"occluders", std::string("contours")}, {"occluders.inset", inset}});
  }

  /// Calls `found(x, z, visibility)` for each pixel that shows the ground.
  template <class Found>
  static void onGround(const scene::Scene& scene, const Rendered& rendered, Found found) {
    const glm::dmat4 fromLight = glm::inverse(scene.lights[0].toLightSpace());
    for (size_t i = 0; i < rendered.product.pixels(); ++i) {
      const float* receiver = rendered.receivers.data.data() + 4 * i;
      if (receiver[3] < 0.0F) continue;
      const glm::dvec3 world = fromLight * glm::dvec4(receiver[0], receiver[1], receiver[2], 1.0);
      if (world.y < 0.01) found(glm::dvec2(world.x, world.z), double(rendered.product.data[i]));
    }
  }

  /// Share of the light that a card hides from a point of the ground: the overlap of two intervals on either
  /// axis.
  static double hidden(const Card& card, glm::dvec2 at) {
    double share = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      const double k = kLightHeight / card.height;
      const double low = at[axis] + (card.low[axis] - at[axis]) * k,
                   high = at[axis] + (card.high[axis] - at[axis]) * k;
      share *=
          std::max(0.0, std::min(high, 0.5 * kLightSize) - std::max(low, -0.5 * kLightSize)) / kLightSize;
    }
    return share;
  }
};

TEST_F(Contours, OfARectangleEncloseItMovedInwards) {
  // The map's margin is one texel, so that texels' borders are the card's. A contour cuts a triangle off each
  // corner, of legs of (1 - t) / 2 texels.
  const Card card{{-0.3, -0.2}, {0.3, 0.2}};
  const scene::Scene scene = sceneOf({card});
  const glm::dvec2 texel = (card.high - card.low) / double(kContourMapSize - 2);
  const glm::dvec2 texelOnLight = texel * (kLightHeight / card.height / kLightSize);
  for (const double inset : {0.0, 0.5, 1.0}) {
    const Card moved{card.low + 0.5 * inset * texel, card.high - 0.5 * inset * texel};
    const double corners = 4.0 * (1.0 - inset) * (1.0 - inset) / 8.0 * texelOnLight.x * texelOnLight.y;
    int partly = 0;
    onGround(scene, contours(scene, inset), [&](glm::dvec2 at, double visibility) {
      const double expected = 1.0 - hidden(moved, at);
      partly += expected > 0.0 && expected < 1.0;
      ASSERT_NEAR(visibility, expected + 0.5 * corners, 0.5 * corners + 1e-3)
          << "t = " << inset << " at " << at.x;
    });
    EXPECT_GT(partly, 200);
  }
}

TEST_F(Contours, ThroughTexelCentresLoseWhatIsOneTexelWide) {
  // Sixty-two texels of 0.01 across; the middle card fills one column of them.
  const Card thin{{0.0, -0.3}, {0.01, 0.3}}, left{{-0.31, -0.3}, {-0.27, 0.3}},
      right{{0.27, -0.3}, {0.31, 0.3}};
  const scene::Scene scene = sceneOf({left, thin, right});
  int shadowed = 0;
  const Rendered borders = contours(scene, 0.0), centres = contours(scene, 1.0);
  std::vector<double> atBorders;
  onGround(scene, borders, [&](glm::dvec2, double visibility) { atBorders.push_back(visibility); });
  size_t pixel = 0;
  onGround(scene, centres, [&](glm::dvec2 at, double visibility) {
    const double byBorders = atBorders[pixel++];
    // Where the thin card alone stands before the light.
    if (hidden(left, at) > 0.0 || hidden(right, at) > 0.0 || hidden(thin, at) < 0.05) return;
    ++shadowed;
    EXPECT_NEAR(byBorders, 1.0 - hidden(thin, at), 0.01);
    EXPECT_EQ(visibility, 1.0);
  });
  EXPECT_GT(shadowed, 20);
}

TEST_F(Contours, MissWhatLiesInFrontOfALargerSurface) {
  // The upper card lies within the lower one's outline as the map sees it. From beside both its shadow falls
  // outside that of the lower one, yet the contour runs around the lower one only.
  const Card lower{{-0.5, -0.5}, {0.5, 0.5}, 0.15}, upper{{-0.2, -0.2}, {0.2, 0.2}, 1.2};
  const scene::Scene both = sceneOf({lower, upper});
  const Rendered contoursOfBoth = contours(both, 0.0);
  const Rendered meshOfBoth = shadows(both, {{"occluders", std::string("microquads")}});
  std::vector<double> ofMesh;
  onGround(both, meshOfBoth, [&](glm::dvec2, double visibility) { ofMesh.push_back(visibility); });
  int missed = 0;
  size_t pixel = 0;
  onGround(both, contoursOfBoth, [&](glm::dvec2 at, double visibility) {
    const double byMesh = ofMesh[pixel++];
    // Both cards hide rectangles of the light; only where the upper one's is not within the lower one's does
    // it matter.
    const double hiddenByLower = hidden(lower, at), hiddenByUpper = hidden(upper, at);
    if (hiddenByLower > 0.01 || hiddenByUpper < 0.1) return;
    ++missed;
    EXPECT_NEAR(visibility, 1.0 - hiddenByLower, 0.02) << at.x << " " << at.y;
    EXPECT_LT(byMesh, 1.0 - 0.5 * hiddenByUpper) << at.x << " " << at.y;
  });
  EXPECT_GT(missed, 10);
}

}  // namespace
}  // namespace limen::techniques
