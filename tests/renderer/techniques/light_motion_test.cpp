// SPDX-License-Identifier: BSD-3-Clause
// Shadows under a moving light: changes from frame to frame in closed form, and the swimming of a level's
// blocks predicted from where the light puts the map's grid.
#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/techniques/soft_shadows/change/light_motion.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kMotionPx{56, 42};
constexpr double kLightY = 2.0, kEdgeY = 1.0, kLightSide = 0.4;

/// A half-plane x < 0, and two far cards nearer to the ground that alone bound the map in x: as the light
/// moves, the half-plane's edge moves over the map's grid.
scene::Scene unpinnedHalfPlane() {
  scene::Scene scene;
  scene::addGround(scene, 8.0);
  scene::addPart(scene, "half_plane", scene::card({-0.45, kEdgeY, 0.0}, {0.0, 0.0, 1.0}, {0.45, 0.0, 0.0}),
                 glm::vec3(0.5F));
  for (const double x : {-1.95, 1.95})
    scene::addPart(scene, "far_card", scene::card({x, 0.5, 0.0}, {0.0, 0.0, 0.1}, {0.05, 0.0, 0.0}),
                   glm::vec3(0.5F));
  scene.lights = {scene::lightTowards({0.0, kLightY, 0.0}, glm::dvec3(0.0), glm::dvec2(kLightSide))};
  scene::setStillCamera(scene, scene::orbitCamera({0.3, 0.0, 0.0}, 2.2, 75.0, 32.0));
  return scene;
}

/// The angle at which light_step moves the light along the world's x.
double alongWorldX(const scene::AreaLight& light) {
  const double angle = glm::degrees(std::atan2(light.axisY.x, light.axisX.x));
  return angle < 0.0 ? angle + 360.0 : angle;
}

/// World positions of the ground's receivers about the half-plane's penumbra.
struct GroundPoint {
  size_t pixel;
  double x;
};
std::vector<GroundPoint> groundPoints(const scene::AreaLight& light, const Image& receivers) {
  std::vector<GroundPoint> points;
  const glm::dmat4 fromLight = glm::inverse(light.toLightSpace());
  for (size_t i = 0; i < receivers.pixels(); ++i) {
    const float* p = receivers.data.data() + 4 * i;
    if (p[3] < 0.0F) continue;
    const glm::dvec3 world = fromLight * glm::dvec4(p[0], p[1], p[2], 1.0);
    // Beyond these no ray to the light meets another edge than the half-plane's.
    if (std::abs(world.y) < 0.01 && std::abs(world.x) < 0.9 && std::abs(world.z) < 0.9)
      points.push_back({i, world.x});
  }
  return points;
}

/// Share of a light centred at `lightX` that the ground sees at x past an edge at `edge`: light points l with
/// x + (l - x) h / H > edge.
double pastEdge(double x, double lightX, double edge) {
  const double first = x + (edge - x) * kLightY / kEdgeY;
  return std::clamp((lightX + 0.5 * kLightSide - first) / kLightSide, 0.0, 1.0);
}

class LightMotionTest : public TechniqueTest {
 protected:
  /// Where level `level` of the map puts the half-plane's edge, given the light. A texel is covered if its
  /// centre is, a block if one of its texels is.
  static double edgeOfBlocks(const scene::Scene& scene, int resolution, int level) {
    const frame::LightFrustum frustum = frame::LightCasters(scene).fit(glm::dvec2(0.0), resolution);
    const scene::AreaLight& light = scene.lights[0];
    const int axis = std::abs(light.axisX.x) > 0.5 ? 0 : 1;
    const double sign = axis == 0 ? light.axisX.x : light.axisY.x, depth = kLightY - kEdgeY;
    const double low = frustum.low[axis], texel = (frustum.high[axis] - low) / resolution;
    const double edge = (sign * (0.0 - light.centre.x) / depth - low) / texel;  // in texels
    // Covered are the texels below the edge, or those above it where the map's axis runs the other way.
    const double nearest = std::floor(edge + 0.5), block = std::exp2(level);
    const double moved =
        sign > 0.0 ? std::ceil(nearest / block) * block : std::floor(nearest / block) * block;
    return light.centre.x + sign * (low + moved * texel) * depth;
  }
};

TEST_F(LightMotionTest, ChangesAreThoseOfTheClosedForm) {
  const scene::Scene scene = makeScene("half_plane");
  const scene::AreaLight& light = scene.lights[0];
  constexpr double kShare = 0.15;
  // Backprojection is exact up to rounding where texels end with the caster (0.002 a frame, see
  // half_plane.yaml). Samples in 16 rows know an edge to 1 / 32, in either frame.
  for (const auto& [inner, bound] : std::vector<std::pair<std::string, double>>{
           {"exact_union", 1e-5}, {"backprojection", 0.004}, {"bitmask", 1.0 / 16.0 + 0.004}}) {
    Given given = {{"inner", inner}, {"light_step", kShare}, {"direction_deg", alongWorldX(light)}};
    if (inner != "exact_union") given["inner.budget.limit"] = int64_t{0};
    given = withMaps("soft_shadows/change", 64, given);
    const Rendered change = render(scene, "soft_shadows/change", given, kMotionPx);
    given["quantity"] = std::string("mean_absolute");
    given["quantity.steps"] = int64_t{3};
    const Rendered mean = render(scene, "soft_shadows/change", given, kMotionPx);
    int changing = 0;
    for (const GroundPoint& point : groundPoints(light, change.receivers)) {
      std::array<double, 4> seen{};  // before three steps, two, one, and now
      for (size_t i = 0; i < 4; ++i)
        seen[i] = pastEdge(point.x, light.centre.x - (3.0 - double(i)) * kShare * kLightSide, 0.0);
      const double step = seen[3] - seen[2];
      ASSERT_NEAR(change.product.data[point.pixel], step, bound) << inner << " at x = " << point.x;
      // The light goes one way, so that no change takes another back.
      ASSERT_NEAR(mean.product.data[point.pixel], (seen[3] - seen[0]) / 3.0, bound) << inner;
      changing += std::abs(step) > 0.9 * kShare;
    }
    EXPECT_GT(changing, 100) << inner;
  }
}

TEST_F(LightMotionTest, OccludersSwimAsTheEdgeOfTheirLevelsBlocksDoes) {
  constexpr int kMap = 512;
  constexpr double kShare = 0.25;  // 0.1 m, some six texels
  std::vector<double> swimming;
  for (const int level : {0, 1, 2, 3}) {
    double squares = 0.0;
    int points = 0;
    for (const double start : {-0.3, -0.17, -0.06, 0.04, 0.13, 0.29}) {
      const scene::Scene built = unpinnedHalfPlane();
      const double direction = alongWorldX(built.lights[0]);
      const double angle = glm::radians(direction);
      const glm::dvec2 way(std::cos(angle), std::sin(angle));
      const scene::Scene after = withMovedLight(built, start * way),
                         before = withMovedLight(built, (start - kShare) * way);
      const Rendered change = render(after, "soft_shadows/change",
                                     inThesisForm(withMaps("soft_shadows/change", kMap,
                                                           {{"light_step", kShare},
                                                            {"direction_deg", direction},
                                                            {"inner.levels", std::string("fixed")},
                                                            {"inner.levels.level", int64_t{level}}}),
                                                  "inner."),
                                     kMotionPx);
      const double edgeBefore = edgeOfBlocks(before, kMap, level),
                   edgeAfter = edgeOfBlocks(after, kMap, level);
      for (const GroundPoint& point : groundPoints(after.lights[0], change.receivers)) {
        const double expected = pastEdge(point.x, after.lights[0].centre.x, edgeAfter) -
                                pastEdge(point.x, before.lights[0].centre.x, edgeBefore);
        // Rounding as where texels end with the caster (half_plane.yaml), in two frames.
        ASSERT_NEAR(change.product.data[point.pixel], expected, 0.004)
            << "level " << level << ", light at " << start << ", x = " << point.x;
        const double exact = pastEdge(point.x, after.lights[0].centre.x, 0.0) -
                             pastEdge(point.x, before.lights[0].centre.x, 0.0);
        squares += std::pow(change.product.data[point.pixel] - exact, 2);
        ++points;
      }
    }
    ASSERT_GT(points, 500);
    swimming.push_back(std::sqrt(squares / points));
    RecordProperty("swimming_level_" + std::to_string(level), std::to_string(swimming.back()));
  }
  // Where the edge falls within a block before and after a step of many texels has nothing to do with each
  // other: differences of two uniform numbers, whose spread is proportional to the block. Six steps know a
  // spread to about a third, hence three levels, eight times the block, for a safe statement.
  EXPECT_GT(swimming[3], 3.0 * swimming[0]);
}

TEST_F(LightMotionTest, LightThatStandsStillChangesNothing) {
  const scene::Scene scene = makeScene("two_boxes");
  for (const char* inner : {"backprojection", "bitmask", "ray_traced", "exact_union"})
    for (const char* quantity : {"last_step", "mean_absolute"})
      for (const char* smoothing : {"none", "history"}) {
        Given given = {{"inner", std::string(inner)},
                       {"quantity", std::string(quantity)},
                       {"smoothing", std::string(smoothing)},
                       {"light_step", 0.0}};
        if (std::string(inner) == "ray_traced") given["inner.samples"] = int64_t{16};
        if (std::string(quantity) == "mean_absolute")
          given["quantity.steps"] = int64_t{2};
        else if (std::string(smoothing) == "history")
          given["smoothing.lead_in"] = int64_t{1};
        for (const float value : render(scene, "soft_shadows/change", given, {24, 18}).product.data)
          ASSERT_EQ(value, 0.0F) << inner << ", " << quantity << ", " << smoothing;
      }
}

TEST_F(LightMotionTest, MotionEndsWhereTheSceneHasItsLight) {
  const scene::Scene scene = makeScene("sphere_grid", {{"tessellation", int64_t{6}}});
  for (const char* inner : {"backprojection", "bitmask"}) {
    const std::string stillName = std::string("soft_shadows/") + inner;
    const Rendered still = render(scene, stillName, withMaps(stillName, 128), kMotionPx);
    const auto moved = [&](Given given) {
      given["inner"] = std::string(inner);
      return render(scene, "soft_shadows/in_motion", withMaps("soft_shadows/in_motion", 128, given),
                    kMotionPx);
    };
    EXPECT_EQ(moved({}).product.data, still.product.data) << inner;
    // A history with all weight on the last frame shows that frame.
    const Given history = {{"smoothing", std::string("history")},
                           {"smoothing.light_step", 0.3},
                           {"smoothing.steps", int64_t{3}},
                           {"smoothing.alpha", 1.0}};
    EXPECT_EQ(moved(history).product.data, still.product.data) << inner;
  }
}

TEST_F(LightMotionTest, NothingLeavesItsRangeHoweverFarTheLightGoes) {
  for (const char* name : {"degenerate_soup", "box_under_light"})
    for (const glm::ivec2 sizePx : {glm::ivec2(1, 1), glm::ivec2(21, 13)})
      for (const double step : {0.3, 100.0})
        for (const char* technique : {"soft_shadows/change", "soft_shadows/in_motion"}) {
          const bool isChange = std::string(technique) == "soft_shadows/change";
          for (const char* inner : {"backprojection", "bitmask"}) {
            const std::string way = isChange ? "" : "smoothing.";
            const Given given = {
                {"inner", std::string(inner)},
                {way + "light_step", step},
                {way + "direction_deg", 30.0},
                {"smoothing", std::string("history")},
                {isChange ? "smoothing.lead_in" : "smoothing.steps", int64_t{isChange ? 1 : 2}}};
            const Rendered rendered =
                render(makeScene(name), technique, withMaps(technique, 64, given), sizePx);
            for (const float value : rendered.product.data)
              ASSERT_TRUE(value >= (isChange ? -1.0F : 0.0F) && value <= 1.0F) << name << ": " << value;
          }
        }
}

TEST_F(LightMotionTest, LeadInStepsAreSeenByTheHistoryAlone) {
  // Two steps of which the last is measured: the change of the averages, as a history of both steps has them.
  const scene::Scene scene = makeScene("two_boxes");
  constexpr double kAlpha = 0.3, kShare = 0.2;
  const auto averaged = [&](int stepsBack) {
    const scene::Scene then = withMovedLight(scene, {-kShare * stepsBack, 0.0});
    return render(then, "soft_shadows/in_motion",
                  withMaps("soft_shadows/in_motion", 128,
                           {{"smoothing", std::string("history")},
                            {"smoothing.light_step", kShare},
                            {"smoothing.steps", int64_t{2 - stepsBack}},
                            {"smoothing.alpha", kAlpha}}),
                  kMotionPx);
  };
  const Rendered before = averaged(1), after = averaged(0);
  const Rendered change = render(scene, "soft_shadows/change",
                                 withMaps("soft_shadows/change", 128,
                                          {{"light_step", kShare},
                                           {"smoothing", std::string("history")},
                                           {"smoothing.alpha", kAlpha},
                                           {"smoothing.lead_in", int64_t{1}}}),
                                 kMotionPx);
  int changing = 0;
  for (size_t i = 0; i < change.product.pixels(); ++i) {
    if (before.receivers.data[4 * i + 3] < 0.0F || after.receivers.data[4 * i + 3] < 0.0F) continue;
    ASSERT_EQ(change.product.data[i], after.product.data[i] - before.product.data[i]) << "pixel " << i;
    changing += change.product.data[i] != 0.0F;
  }
  EXPECT_GT(changing, 50);
}

TEST_F(LightMotionTest, WhatMeansNothingCannotBeWritten) {
  const auto accepted = [](const char* technique, const Given& given) {
    return !refusal(technique, given).has_value();
  };
  EXPECT_TRUE(accepted("soft_shadows/change", {}));
  EXPECT_TRUE(
      accepted("soft_shadows/change", {{"smoothing", std::string("history")}, {"smoothing.alpha", 0.5}}));
  EXPECT_FALSE(accepted("soft_shadows/change", {{"smoothing.alpha", 0.5}}));
  EXPECT_FALSE(accepted("soft_shadows/change", {{"quantity.steps", int64_t{2}}}));
  EXPECT_FALSE(accepted("soft_shadows/change",
                        {{"smoothing", std::string("history")}, {"smoothing.clamp.radius", int64_t{2}}}));
  EXPECT_FALSE(accepted("soft_shadows/change", {{"inner.samples", int64_t{64}}}));
  EXPECT_FALSE(accepted("soft_shadows/change",
                        {{"inner", std::string("ray_traced")}, {"inner.budget.limit", int64_t{64}}}));
  EXPECT_FALSE(accepted("soft_shadows/in_motion", {{"smoothing.light_step", 0.1}}));
  // The inner technique refuses what it would refuse by itself.
  EXPECT_FALSE(accepted("soft_shadows/change", withMaps("soft_shadows/change", 64,
                                                        {{"inner.levels", std::string("fixed")},
                                                         {"inner.levels.level", int64_t{9}}})));
}

}  // namespace
}  // namespace limen::techniques
