// SPDX-License-Identifier: BSD-3-Clause
// Forms of the depth bias against each other where they must agree, and against how a plane shadows itself in
// theory.
#include <algorithm>
#include <cmath>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class BiasForms : public TechniqueTest {
 protected:
  static Image product(const scene::Scene& scene, Given given, glm::ivec2 sizePx = {48, 36}) {
    given.emplace("resolution", int64_t{64});
    return render(scene, "soft_shadows/bitmask", inThesisForm(given), sizePx).product;
  }

  /// A plane that leans away from the light and nothing else.
  static scene::Scene leaningPlane(double tilt, double lightSize) {
    scene::Scene scene = makeScene("resting_sphere", {{"tilt", tilt}, {"light_size", lightSize}});
    scene.parts.resize(1);
    scene.mesh.triangles.resize(scene.parts[0].triangleCount);
    return scene;
  }

  /// Share of the plane's receivers that do not see the whole light, as all of them do. Texels of which the
  /// centre misses the plane know nothing of its slope: receivers within the outer 30 % of its extents, more
  /// than a texel of level 4, are left out.
  static double acne(const scene::Scene& scene, int level, double scale, const std::string& occluders) {
    Given given = inThesisForm({{"resolution", int64_t{128}},
                                {"occluders", occluders},
                                {"levels", std::string("fixed")},
                                {"levels.level", int64_t{level}},
                                {"bias.constant", 1e-5},
                                {"bias", std::string("stored")},
                                {"bias.scale", scale}});
    const bool contours = occluders == "contours";
    if (!contours) given["occluders.gap_fill"] = std::string("none");
    const Rendered rendered =
        render(scene, contours ? "soft_shadows/backprojection" : "soft_shadows/bitmask", given, {96, 72});
    glm::dvec2 extents(0.0);
    const glm::dmat4 toLight = scene.lights[0].toLightSpace();
    for (const glm::uvec3& triangle : scene.mesh.triangles)
      for (int corner = 0; corner < 3; ++corner)
        extents = glm::max(
            extents, glm::abs(glm::dvec2(toLight * glm::dvec4(scene.mesh.positions[triangle[corner]], 1.0))));
    // A sample of a mask is 1/256; signed areas of contours cancel but for the rounding of floats.
    constexpr float kLit = 1.0F - 1e-5F;
    int receivers = 0, dark = 0;
    for (size_t i = 0; i < rendered.product.pixels(); ++i) {
      const float* receiver = rendered.receivers.data.data() + 4 * i;
      if (receiver[3] < 0.0F || std::abs(receiver[0]) > 0.7 * extents.x ||
          std::abs(receiver[1]) > 0.7 * extents.y)
        continue;
      ++receivers;
      dark += rendered.product.data[i] < kLit;
    }
    EXPECT_GT(receivers, 500);
    return double(dark) / receivers;
  }
};

TEST_F(BiasForms, AConstantIsTheReceiversSlopeWithoutSlope) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const int64_t level : {0, 2})
    EXPECT_EQ(product(scene, {{"bias", std::string("constant")},
                              {"levels", std::string("fixed")},
                              {"levels.level", level}})
                  .data,
              product(scene, {{"bias.slope", 0.0}, {"levels", std::string("fixed")}, {"levels.level", level}})
                  .data);
}

TEST_F(BiasForms, AConstantForALevelIsThatConstant) {
  // Powers of two, so that products are exact. What is in umbra is told before a level is known.
  const scene::Scene scene = makeScene("two_boxes");
  const Image grown = product(scene, {{"bias", std::string("per_level")},
                                      {"bias.constant", std::ldexp(1.0, -9)},
                                      {"bias.growth", 2.0},
                                      {"levels", std::string("fixed")},
                                      {"levels.level", int64_t{3}}});
  const Image plain = product(scene, {{"bias", std::string("constant")},
                                      {"bias.constant", std::ldexp(1.0, -6)},
                                      {"levels", std::string("fixed")},
                                      {"levels.level", int64_t{3}}});
  int partly = 0;
  for (size_t i = 0; i < grown.pixels(); ++i) {
    if (grown.data[i] == 0.0F) continue;
    ASSERT_EQ(grown.data[i], plain.data[i]);
    partly += grown.data[i] < 1.0F;
  }
  EXPECT_GT(partly, 50);
}

// In tangents t from the eye, 1/z of a plane is linear: 1/z - 1/p_z = k (t - t_p) with k = n_x / d. The light
// spans w / 2 (1/z - 1/p_z) to either side of the way from p to the eye, hence a part c = w / 2 |k| of the
// distance to where the plane has depth z: below 1 the plane is lit. For the plane through (0, 0, H) that
// leans by the angle a, c = w / (2 H) tan a everywhere.
//
// Let p lie D texels of its level below (in depth) the upper edge of a texel of the plane; the texel's
// rectangle lies at the depth of its uppermost centre, h = 1 / 2^(level + 1) below the edge. It hides some of
// the light if D - 1 < c (D - h), that is, D - h < (1 - h) / (1 - c). Its stored bias, with the scale g,
// keeps it from that where D - h <= g (1 - h), to first order of the change of depth over a texel and exactly
// for g = 1. Hence no acne if g >= 1 / (1 - c); with g = 1, on a part of (1 - h) c / (1 - c) of the plane.
TEST_F(BiasForms, StoredOnesKeepAPlaneLitWhereTheoryHasIt) {
  constexpr double kTilt = 60.0, kHalfLight = 0.2, kLightHeight = 4.0;
  for (const double lightSize : {1.0, 4.0}) {
    const double c = lightSize * kHalfLight / kLightHeight * std::tan(glm::radians(kTilt));
    ASSERT_LT(c, 0.5);  // the rectangle after the next is out of reach then
    const scene::Scene scene = leaningPlane(kTilt, lightSize);
    for (const int level : {0, 1, 2, 4}) {
      // Second order: depth changes by some 8 % over a texel of level 4 here, 1/z is convex, and g b falls
      // short of the depth at D = g by about g (g - 1) b / z of b, 7 % at most.
      EXPECT_EQ(acne(scene, level, 1.1 / (1.0 - c), "micropatches"), 0.0)
          << "level " << level << ", light " << lightSize;
      // Less what hides too little of the light for a sample (a thirty-second of its width: a sixteenth of
      // the part), and what the pixels' grid makes of the texels'.
      const double expected = (1.0 - 0.5 / (1 << level)) * c / (1.0 - c);
      const double measured = acne(scene, level, 1.0, "micropatches");
      EXPECT_GT(measured, 0.75 * expected) << "level " << level << ", light " << lightSize;
      EXPECT_LT(measured, 1.15 * expected) << "level " << level << ", light " << lightSize;
    }
  }
}

TEST_F(BiasForms, StoredOnesSufficeAsTheyAreForALightWithoutExtent) {
  // c below 1e-3: not one pixel in a thousand.
  const scene::Scene scene = leaningPlane(60.0, 0.005);
  for (int level = 0; level <= 6; ++level)
    EXPECT_LE(acne(scene, level, 1.0, "micropatches"), 1e-3) << "level " << level;
}

// Microrects reach further than texels of their level, and what they store with them: the same bound.
// Contours surround the texels that block, so that they have none where these have none.
TEST_F(BiasForms, StoredOnesKeepAPlaneLitForMicrorectsAndContours) {
  constexpr double kTilt = 60.0, kHalfLight = 0.2, kLightHeight = 4.0, kLightSize = 2.0;
  const double c = kLightSize * kHalfLight / kLightHeight * std::tan(glm::radians(kTilt));
  const scene::Scene scene = leaningPlane(kTilt, kLightSize);
  for (const char* occluders : {"microrects", "contours"})
    for (const int level : {0, 1, 2, 3}) {
      EXPECT_EQ(acne(scene, level, 1.1 / (1.0 - c), occluders), 0.0) << occluders << ", level " << level;
      // It is the bias that does it.
      EXPECT_GT(acne(scene, level, 0.0, occluders), 0.2) << occluders << ", level " << level;
    }
}

TEST_F(BiasForms, AStoredBiasChangesWhatIsTestedAndNotWhereItLies) {
  // Nothing of a flat card parallel to the light slopes: its biases are zero, its shadow is that of no bias.
  const scene::Scene scene = makeScene("parallel_rectangle");
  EXPECT_EQ(product(scene, {{"bias", std::string("stored")}, {"bias.scale", 16.0}}).data,
            product(scene, {{"bias", std::string("constant")}}).data);
  EXPECT_EQ(
      product(
          scene,
          {{"occluders", std::string("microrects")}, {"bias", std::string("stored")}, {"bias.scale", 16.0}})
          .data,
      product(scene, {{"occluders", std::string("microrects")}, {"bias", std::string("constant")}}).data);
  // One that leans by a slope of 2 and is tested with its own bias shadows the ground far below it just as
  // well.
  scene::Scene leaning = scene;
  for (glm::dvec3& position : leaning.mesh.positions)
    if (position.y > 0.1) position.y += 0.8 * position.x + 0.5 * position.z;
  EXPECT_EQ(
      product(leaning, {{"bias", std::string("stored")}, {"occluders.gap_fill", std::string("diagonal")}})
          .data,
      product(leaning, {{"bias", std::string("constant")}, {"occluders.gap_fill", std::string("diagonal")}})
          .data);
}

}  // namespace
}  // namespace limen::techniques
