// SPDX-License-Identifier: BSD-3-Clause
// The popping predictor as a technique on changes of level whose outcome is known from their geometry.
#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/scene/lod_set.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kSwitchSize{96, 64};
const char* const kSwitch = "popping/lod_switch";
const char* const kReference = "popping/lod_switch_reference";

class PoppingSwitch : public TechniqueTest {
 protected:
  static Rendered predict(const scene::Scene& scene, Given given, const char* technique = kSwitch) {
    return render(scene, technique, given, kSwitchSize, true);
  }
  /// R = ln(0.375 Sigma) / ln 2.25 (Schwarz 2009, section 10.3.4).
  static double ratingOf(double sigma) { return std::log(0.375 * sigma) / std::log(2.25); }
};

/// A ball of radius 1, smooth and coarse, before a wall; the camera passes at `speed` in world units a
/// second.
scene::Scene ball(double distance, double speed) {
  scene::LodSet set;
  set.name = "ball";
  for (const int cells : {12, 3})
    set.levels.push_back({scene::sphere(glm::dvec3(0.0), 1.0, cells), 0.0, 0.0});
  scene::Scene scene;
  scene::addPart(scene, "wall", scene::card({0.0, 0.0, -3.0}, {200.0, 0.0, 0.0}, {0.0, 200.0, 0.0}),
                 glm::vec3(0.3F));
  scene::addLodObject(scene, set, {}, {"ball", glm::vec3(0.8F)}, {5.0});
  scene.lights = {scene::lightTowards({-30.0, 50.0, 40.0}, glm::dvec3(0.0), glm::dvec2(1.0))};
  scene::Camera from;
  from.eye = {0.0, 0.0, distance};
  scene.camera.keys = {{0.0, from}};
  if (speed == 0.0) return scene;
  scene::Camera to = from;
  to.eye.x += speed;
  to.target.x += speed;
  scene.camera.keys.push_back({1.0, to});
  scene.camera.runIn = true;
  return scene;
}

/// A wall at z = -3 that is flat in level 0 and folded by a hundredth in level 1; before it, at z = 2, a post
/// 2 wide. The eye at z = 6 moves to the right by 0.5 in 0.1 s.
scene::Scene post() {
  scene::LodSet set;
  set.name = "wall";
  set.levels.push_back({scene::card({0.0, 0.0, -3.0}, {60.0, 0.0, 0.0}, {0.0, 40.0, 0.0}), 0.0, 0.0});
  scene::Mesh folded;
  constexpr int kFolds = 160;
  for (int i = 0; i <= kFolds; ++i)
    for (const double y : {-20.0, 20.0})
      folded.positions.emplace_back(-30.0 + 60.0 * i / kFolds, y, i % 2 == 0 ? -3.005 : -2.995);
  for (uint32_t i = 0; i < kFolds; ++i) {
    const uint32_t a = 2 * i;
    folded.triangles.emplace_back(a, a + 2, a + 1);
    folded.triangles.emplace_back(a + 1, a + 2, a + 3);
  }
  set.levels.push_back({folded, 0.005, 0.0});
  scene::Scene scene;
  scene::addPart(scene, "post", scene::card({0.0, 0.0, 2.0}, {1.0, 0.0, 0.0}, {0.0, 10.0, 0.0}),
                 glm::vec3(0.2F));
  scene::addLodObject(scene, set, {}, {"wall", glm::vec3(0.6F)}, {5.0});
  scene.lights = {scene::lightTowards({-60.0, 0.0, 30.0}, glm::dvec3(0.0), glm::dvec2(1.0))};
  scene::Camera from;
  from.eye = {0.0, 0.0, 6.0};
  scene::Camera to = from;
  to.eye.x += 5.0;
  to.target.x += 5.0;
  scene.camera.keys = {{0.0, from}, {1.0, to}};
  scene.camera.runIn = true;
  return scene;
}
constexpr double kPostDt = 0.1;
/// Pixels a unit at distance 1: 45 degrees over 64 rows.
const double kFocalPx = 32.0 / std::tan(std::acos(-1.0) / 8.0);

double largestOf(const Image& image) { return *std::max_element(image.data.begin(), image.data.end()); }

/// Largest |a - b| / max(b, 0.1): as the descriptors state a map's error.
double mapError(const Image& a, const Image& b) {
  double largest = 0.0;
  for (size_t i = 0; i < a.data.size(); ++i)
    largest = std::max(largest, std::abs(double{a.data[i]} - b.data[i]) / std::max(double{b.data[i]}, 0.1));
  return largest;
}

TEST_F(PoppingSwitch, BetweenEqualLevelsIsNeverSeen) {
  for (const char* technique : {kSwitch, kReference}) {
    const Rendered out =
        predict(ball(6.0, 1.0), {{"from_level", int64_t{1}}, {"to_level", int64_t{1}}}, technique);
    EXPECT_EQ(largestOf(out.product), 0.0) << technique;
    EXPECT_EQ(out.counter("regions"), 0.0);
    EXPECT_EQ(out.counter("has_region"), 0.0);
    EXPECT_EQ(out.counter("popping_px"), 0.0);
    EXPECT_EQ(out.counter("coverage_of_object"), 0.0);
    EXPECT_EQ(out.counter("max_de94"), 0.0);
    // What people answer without popping: 10 of 224 (Schwarz 2009, section 10.4), here as its printed 4.46 %.
    EXPECT_NEAR(out.counter("detection_probability"), 0.0446, 1e-12);
    // One below a region of a single pixel at the threshold of 2 JND.
    EXPECT_NEAR(out.counter("rating"), ratingOf(2.0) - 1.0, 1e-12);
  }
}

TEST_F(PoppingSwitch, FallsWithDistance) {
  // At twice the distance the same change covers a quarter of the pixels at no more contrast, so that Sigma,
  // a Minkowski sum of exponent 2.4, has a factor of about 4^(-1/2.4) = 0.56: R falls by 0.71. What becomes
  // finer than a pixel falls faster. Half of that is asked for.
  double before = 1e9;
  for (const double distance : {4.0, 8.0, 16.0, 32.0}) {
    const Rendered out = predict(ball(distance, 0.0), {{"samples", int64_t{4}}});
    EXPECT_LT(out.counter("rating"), before - 0.35) << distance;
    EXPECT_EQ(out.counter("object_distance"), distance);
    before = out.counter("rating");
  }
}

TEST_F(PoppingSwitch, IsTheSameThereAndBackButForFlicker) {
  // The predictor takes the magnitude of a difference, and each frame brings its own luminance and velocity;
  // disocclusion takes the larger visibility of both levels. Flicker alone looks at the new frame only.
  for (const std::string presentation : {"static", "dynamic"}) {
    const Given there = {{"presentation", presentation}, {"predictor.flicker", "ignored"}};
    Given back = there;
    back["from_level"] = int64_t{0};
    back["to_level"] = int64_t{1};
    const Rendered a = predict(ball(6.0, 3.0), there), b = predict(ball(6.0, 3.0), back);
    EXPECT_GT(largestOf(a.product), 2.0);
    EXPECT_LT(mapError(a.product, b.product), 1e-4) << presentation;
    EXPECT_NEAR(a.counter("rating"), b.counter("rating"), 1e-3);
    EXPECT_EQ(a.counter("triangles_before"), b.counter("triangles_after"));
  }
}

TEST_F(PoppingSwitch, OfACameraAtRestIsThatOfTheStaticPresentation) {
  const Rendered still = predict(ball(6.0, 0.0), {{"presentation", "dynamic"}});
  const Rendered shown = predict(ball(6.0, 3.0), {{"presentation", "static"}});
  EXPECT_EQ(still.product.data, shown.product.data);
  EXPECT_EQ(shown.counter("screen_velocity_deg_s"), 0.0);
}

TEST_F(PoppingSwitch, AgreesWithTheReference) {
  for (const scene::Scene& scene : {ball(5.0, 2.0), post()}) {
    const Given given = {
        {"predictor.flicker", "ignored"}, {"presentation.dt_s", 0.05}, {"shading.specular", 0.9}};
    const Rendered gpu = predict(scene, given), reference = predict(scene, given, kReference);
    ASSERT_GT(largestOf(reference.product), 2.0);
    // 1 % on the map, which regions and ratings inherit; a rating is ln Sigma / ln 2.25.
    EXPECT_LT(mapError(gpu.product, reference.product), 0.01);
    EXPECT_NEAR(gpu.counter("rating"), reference.counter("rating"), 0.01 / std::log(2.25));
    EXPECT_EQ(gpu.counter("regions"), reference.counter("regions"));
    EXPECT_EQ(gpu.counter("popping_px"), reference.counter("popping_px"));
    for (const char* same : {"max_de94", "screen_velocity_deg_s", "object_px", "flushed_inputs"})
      EXPECT_EQ(gpu.counter(same), reference.counter(same)) << same;
  }
}

// A matte ball that moves by a fifth of a pixel or more a frame: its shading does not change over time, so
// little flickers in pictures of many samples. With single samples, edges jump by whole pixels, which no
// viewer of the other picture sees.
TEST_F(PoppingSwitch, AliasingThatIsNotShownIsLittleFlicker) {
  const Given all = {
      {"samples", int64_t{4}}, {"predictor.flicker", "ignored"}, {"predictor.disocclusion", "ignored"}};
  Given weighted = all;
  weighted["predictor.flicker"] = "weighted";
  for (const double distance : {6.0, 12.0, 24.0})
    for (const double speed : {distance / 6.0, distance / 2.0}) {
      const scene::Scene scene = ball(distance, speed);
      const double lost =
          1.0 - predict(scene, weighted).counter("sigma_jnd") / predict(scene, all).counter("sigma_jnd");
      EXPECT_LT(lost, 0.1) << distance << ", " << speed;
    }
}

TEST_F(PoppingSwitch, WithFlickerAgreesWithTheReferenceButWhereItIsUndecided) {
  // Flicker is a comparison: where both sides are nearly equal, single precision may decide otherwise.
  const Given given = {{"presentation.dt_s", 0.05}, {"predictor.flicker.max_displacement_px", 100.0}};
  const Rendered gpu = predict(ball(5.0, 2.0), given), reference = predict(ball(5.0, 2.0), given, kReference),
                 without =
                     predict(ball(5.0, 2.0), {{"presentation.dt_s", 0.05}, {"predictor.flicker", "ignored"}});
  int differing = 0, flickering = 0;
  for (size_t i = 0; i < gpu.product.data.size(); ++i) {
    const double value = gpu.product.data[i], expected = reference.product.data[i];
    differing += std::abs(value - expected) > 0.01 * std::max(expected, 0.1);
    flickering += without.product.data[i] > 0.1 && value < 0.5 * without.product.data[i];
  }
  EXPECT_GT(flickering, 0);
  EXPECT_LT(differing, static_cast<int>(gpu.product.data.size()) / 200);
}

TEST_F(PoppingSwitch, IsNotSeenWhereThePostHasJustUncoveredTheWall) {
  const Given common = {
      {"presentation.dt_s", kPostDt}, {"predictor.flicker", "ignored"}, {"samples", int64_t{1}}};
  Given unweighted = common;
  unweighted["predictor.disocclusion"] = "ignored";
  const Rendered with = predict(post(), common), without = predict(post(), unweighted);
  // A column u right of the middle sees the wall, 9 away, at u + f m / 9 in the previous frame, m = 0.5 to
  // the left. The post, 4 away and from -1 to 1, then reached from f (m - 1) / 4 to f (m + 1) / 4.
  const double shift = kFocalPx * 0.5 / 9.0, postLeft = -kFocalPx / 4.0, postRight = kFocalPx / 4.0,
               hiddenUntil = kFocalPx * 1.5 / 4.0 - shift, seenUntil = 48.0 - shift;
  ASSERT_GT(hiddenUntil - postRight, 5.0);
  const auto within = [](double u, double low, double high) { return u > low + 1.5 && u < high - 1.5; };
  int uncovered = 0, seen = 0, beside = 0;
  for (int x = 0; x < kSwitchSize.x; ++x) {
    const double u = x + 0.5 - 48.0;
    for (int y = 8; y < kSwitchSize.y - 8; ++y) {
      const float before = without.product.at(x, y), weighted = with.product.at(x, y);
      if (before < 0.01F) continue;
      if (within(u, postRight, hiddenUntil)) {
        EXPECT_EQ(weighted, 0.0F) << x << ' ' << y;
        ++uncovered;
      } else if (within(u, hiddenUntil, seenUntil) || within(u, -48.0, postLeft)) {
        EXPECT_EQ(weighted, before) << x << ' ' << y;
        ++seen;
      } else if (u > seenUntil + 1.5) {
        // Nobody has seen what lay outside the previous frame.
        EXPECT_EQ(weighted, 0.0F) << x << ' ' << y;
        ++beside;
      }
    }
  }
  EXPECT_GT(uncovered, 20);
  EXPECT_GT(seen, 200);
  EXPECT_GT(beside, 20);
}

TEST_F(PoppingSwitch, KnowsHowFastTheObjectMovesOnTheScreen) {
  // The wall shifts by f 0.5 / 9 pixels in 0.1 s, on the study's display of 41.229 pixels a degree.
  const Rendered out = predict(post(), {{"presentation.dt_s", kPostDt}});
  EXPECT_NEAR(out.counter("screen_velocity_deg_s"), kFocalPx * 0.5 / 9.0 / kPostDt / 41.229, 0.01);
  // Half the time between frames, half the displacement, the same velocity.
  const Rendered half = predict(post(), {{"presentation.dt_s", 0.5 * kPostDt}});
  EXPECT_NEAR(half.counter("screen_velocity_deg_s"), out.counter("screen_velocity_deg_s"), 0.01);
}

TEST_F(PoppingSwitch, TakesTheFrameForAWindowOfTheDisplay) {
  const scene::Scene scene = ball(6.0, 0.0);
  const Rendered out = predict(scene, {});
  EXPECT_NEAR(out.counter("pixels_per_degree"), 41.229, 1e-3);
  const Rendered large = render(scene, kSwitch, {}, 2 * kSwitchSize, true);
  EXPECT_EQ(large.counter("pixels_per_degree"), out.counter("pixels_per_degree"));
  // Twice as many pixels show the ball twice as large: the change is easier to see.
  EXPECT_GT(large.counter("rating"), out.counter("rating"));
}

TEST_F(PoppingSwitch, RefusesObjectsAndLevelsThatAreNotThere) {
  const auto message = [](const Given& given) {
    try {
      predict(ball(6.0, 0.0), given);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message({{"object", int64_t{1}}}).find("no object 1"), std::string::npos);
  EXPECT_NE(message({{"from_level", int64_t{2}}}).find("has 2 levels"), std::string::npos);
}

TEST_F(PoppingSwitch, StaysFiniteInTheEyeOfTheObject) {
  for (const double distance : {0.5, 1e-3})
    for (const char* technique : {kSwitch, kReference}) {
      const Rendered out = predict(ball(distance, 50.0), {{"shading.specular", 1.0}}, technique);
      for (const float value : out.product.data) ASSERT_TRUE(std::isfinite(value));
      for (const Counter& counter : out.counters) EXPECT_TRUE(std::isfinite(counter.value)) << counter.name;
      EXPECT_EQ(out.counter("flushed_inputs"), 0.0);
    }
}

}  // namespace
}  // namespace limen::techniques
