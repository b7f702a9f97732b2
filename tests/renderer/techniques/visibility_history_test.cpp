// SPDX-License-Identifier: BSD-3-Clause
// The history of visibility: its weights in closed form under a moving light, and where it looks for the past
// under a moving camera, against a twin in double precision.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderer/techniques/soft_shadows/change/light_motion.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kHistoryPx{48, 36};

/// A camera that goes round the scene and towards it.
scene::Scene withMovingCamera(scene::Scene scene) {
  const scene::Camera from = scene.camera.at(0.0);
  scene::Camera to = from;
  const glm::dvec3 view = from.target - from.eye;
  to.eye += 0.15 * view + 0.25 * glm::length(view) * glm::normalize(glm::cross(view, from.up));
  scene.camera.keys = {{0.0, from}, {1.0, to}};
  return scene;
}

class VisibilityHistoryTest : public TechniqueTest {
 protected:
  struct Shown {
    Image visibility, positions, normals, depths, receivers;
  };

  static Shown show(frame::Frame& frame, Technique& technique, double timeS) {
    frame.setTime(timeS);
    frame.begin();
    technique.render(frame);
    const auto channel = [&](frame::Channel wanted) {
      return frame.get<frame::GBufferChannel>(frame::ChannelSetting{wanted}).texture().read();
    };
    Shown shown{technique.product().read(), channel(frame::Channel::Position),
                channel(frame::Channel::Normal), channel(frame::Channel::Depth),
                frame.get<frame::Receivers>().texture().read()};
    frame.end();
    return shown;
  }

  static std::unique_ptr<Technique> make(const std::string& name, const Given& given) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(name);
    return info.make(ParameterValues(info.parameters, given));
  }
};

TEST_F(VisibilityHistoryTest, WithAllWeightOnThePresentItIsTheInnerTechniqueBitForBit) {
  const scene::Scene scene = withMovingCamera(makeScene("sphere_grid", {{"tessellation", int64_t{6}}}));
  const frame::GpuScene gpuScene(scene);
  for (const char* inner : {"backprojection", "bitmask"}) {
    frame::Frame frame(context(), scene, gpuScene, kHistoryPx);
    const std::string plainName = std::string("soft_shadows/") + inner;
    const auto plain = make(plainName, withMaps(plainName, 128));
    const auto averaged =
        make("soft_shadows/history",
             withMaps("soft_shadows/history", 128, {{"inner", std::string(inner)}, {"alpha", 1.0}}));
    plain->prepare(frame);
    averaged->prepare(frame);
    for (const double timeS : {0.0, 0.0, 0.1, 0.2, 0.9}) {
      const Shown expected = show(frame, *plain, timeS), shown = show(frame, *averaged, timeS);
      EXPECT_EQ(std::memcmp(expected.visibility.data.data(), shown.visibility.data.data(),
                            expected.visibility.data.size() * sizeof(float)),
                0)
          << inner << " at " << timeS << " s";
    }
  }
}

TEST_F(VisibilityHistoryTest, PastFramesWeighExponentiallyLessWithinThePresentsBounds) {
  constexpr double kAlpha = 0.3, kShare = 0.4;
  constexpr int kSteps = 4;
  const scene::Scene scene = makeScene("two_boxes");
  const Given inner = withMaps("soft_shadows/backprojection", 128);
  for (const int64_t radius : {0, 1, 2}) {
    Image twin, receivers;
    for (int step = 0; step <= kSteps; ++step) {
      const Rendered present = render(withMovedLight(scene, {-kShare * (kSteps - step), 0.0}),
                                      "soft_shadows/backprojection", inner, kHistoryPx);
      if (step == 0) {
        twin = present.product;
        receivers = present.receivers;
        continue;
      }
      const Image past = twin;
      for (int y = 0; y < twin.height; ++y)
        for (int x = 0; x < twin.width; ++x) {
          const double now = present.product.at(x, y);
          const bool wasReceiver = receivers.at(x, y, 3) >= 0.0F;
          double before = past.at(x, y), low = now, high = now;
          for (int v = std::max(y - int(radius), 0); v <= std::min(y + int(radius), twin.height - 1); ++v)
            for (int u = std::max(x - int(radius), 0); u <= std::min(x + int(radius), twin.width - 1); ++u) {
              if (present.receivers.at(u, v, 3) < 0.0F) continue;
              low = std::min(low, double(present.product.at(u, v)));
              high = std::max(high, double(present.product.at(u, v)));
            }
          if (radius > 0) before = std::clamp(before, low, high);
          const bool isReceiver = present.receivers.at(x, y, 3) >= 0.0F;
          twin.at(x, y) = !isReceiver    ? 1.0F
                          : !wasReceiver ? float(now)
                                         : float(kAlpha * now + (1.0 - kAlpha) * before);
        }
      receivers = present.receivers;
    }
    Given given = {{"smoothing", std::string("history")},
                   {"smoothing.alpha", kAlpha},
                   {"smoothing.light_step", kShare},
                   {"smoothing.steps", int64_t{kSteps}},
                   {"smoothing.clamp", std::string(radius > 0 ? "neighbourhood" : "none")}};
    if (radius > 0) given["smoothing.clamp.radius"] = radius;
    const Rendered averaged =
        render(scene, "soft_shadows/in_motion", withMaps("soft_shadows/in_motion", 128, given), kHistoryPx);
    int between = 0;
    for (size_t i = 0; i < twin.pixels(); ++i) {
      // Values up to 1 in single precision, four steps of three roundings each.
      ASSERT_NEAR(averaged.product.data[i], twin.data[i], 1e-6) << "pixel " << i << ", radius " << radius;
      between += twin.data[i] > 0.01F && twin.data[i] < 0.99F;
    }
    EXPECT_GT(between, 50);
  }
}

TEST_F(VisibilityHistoryTest, OneStepOfTheLightLeavesThePastsShareAsLag) {
  // In the penumbra of a half-plane a step by a share s of the light changes visibility by s; the past keeps
  // the weight 1 - alpha of it. The share is the closed form of light_motion_test.cpp; 0.004 is the rounding
  // of backprojection in two frames.
  constexpr double kAlpha = 0.25, kShare = 0.1;
  const scene::Scene scene = makeScene("half_plane");
  const glm::dvec3 axis = scene.lights[0].axisX;
  const double direction = std::abs(axis.x) > 0.5 ? 0.0 : 90.0;
  const Given map = withMaps("soft_shadows/backprojection", 64, {{"budget.limit", int64_t{0}}});
  const Given moving = withMaps("soft_shadows/in_motion", 64,
                                {{"inner.budget.limit", int64_t{0}},
                                 {"smoothing", std::string("history")},
                                 {"smoothing.light_step", kShare},
                                 {"smoothing.direction_deg", direction},
                                 {"smoothing.alpha", kAlpha}});
  const Rendered late = render(scene, "soft_shadows/in_motion", moving, kHistoryPx);
  const Rendered now = render(scene, "soft_shadows/backprojection", map, kHistoryPx);
  double largest = 0.0;
  int inPenumbra = 0;
  for (size_t i = 0; i < now.product.pixels(); ++i) {
    if (now.receivers.data[4 * i + 3] < 0.0F) continue;
    const double lag = std::abs(late.product.data[i] - now.product.data[i]);
    largest = std::max(largest, lag);
    // Farther from either end of the penumbra than the step.
    if (now.product.data[i] < 1.1 * kShare || now.product.data[i] > 1.0 - 1.1 * kShare) continue;
    ASSERT_NEAR(lag, (1.0 - kAlpha) * kShare, 0.004) << "pixel " << i;
    ++inPenumbra;
  }
  EXPECT_GT(inPenumbra, 50);
  EXPECT_LT(largest, (1.0 - kAlpha) * kShare + 0.004);
}

TEST_F(VisibilityHistoryTest, ThePastIsLookedUpWhereTheSurfaceWas) {
  constexpr double kAlpha = 0.2, kDepthTolerance = 0.01, kThenS = 0.2, kNowS = 0.45;
  const double cosine = std::cos(glm::radians(20.0));
  const scene::Scene scene = withMovingCamera(makeScene("two_boxes"));
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, kHistoryPx);
  const Given map = withMaps("soft_shadows/backprojection", 128);
  const auto plain = make("soft_shadows/backprojection", map);
  const auto averaged =
      make("soft_shadows/history", withMaps("soft_shadows/history", 128, {{"alpha", kAlpha}}));
  plain->prepare(frame);
  averaged->prepare(frame);
  show(frame, *averaged, kThenS);
  const Shown product = show(frame, *averaged, kNowS);
  const Shown then = show(frame, *plain, kThenS), now = show(frame, *plain, kNowS);

  const scene::Camera camera = scene.camera.at(kThenS);
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye),
                   right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double focal = 0.5 * kHistoryPx.y / std::tan(0.5 * glm::radians(camera.verticalFovDeg));
  int compared = 0, withoutPast = 0, undecided = 0;
  for (int y = 0; y < kHistoryPx.y; ++y)
    for (int x = 0; x < kHistoryPx.x; ++x) {
      if (now.receivers.at(x, y, 3) < 0.0F) {
        ASSERT_EQ(product.visibility.at(x, y), 1.0F);
        continue;
      }
      const auto vector = [&](const Image& image, int u, int v) {
        return glm::dvec3(image.at(u, v, 0), image.at(u, v, 1), image.at(u, v, 2));
      };
      const glm::dvec3 d = vector(now.positions, x, y) + gpuScene.anchor() - camera.eye;
      const double depth = glm::dot(d, forward);
      const glm::dvec2 place(0.5 * kHistoryPx.x + focal * glm::dot(d, right) / depth - 0.5,
                             0.5 * kHistoryPx.y - focal * glm::dot(d, up) / depth - 0.5);
      const glm::dvec2 corner = glm::floor(place), share = place - corner;
      double sum = 0.0, weights = 0.0;
      bool decided = true;
      for (int tap = 0; tap < 4; ++tap) {
        const int u = int(corner.x) + tap % 2, v = int(corner.y) + tap / 2;
        const double weight = (tap % 2 ? share.x : 1.0 - share.x) * (tap / 2 ? share.y : 1.0 - share.y);
        if (u < 0 || v < 0 || u >= kHistoryPx.x || v >= kHistoryPx.y) continue;
        if (then.receivers.at(u, v, 3) < 0.0F) continue;
        const double difference = std::abs(then.depths.at(u, v) - depth) / (kDepthTolerance * depth);
        const double facing = glm::dot(vector(then.normals, u, v), vector(now.normals, x, y));
        // Float decides otherwise within its rounding of the tolerance; hardly any weight may be any.
        decided = decided && std::abs(difference - 1.0) > 0.01 && std::abs(facing - cosine) > 1e-4;
        if (difference > 1.0 || facing < cosine) continue;
        sum += weight * then.visibility.at(u, v);
        weights += weight;
      }
      if (weights > 0.0 && weights < 0.01) decided = false;
      if (!decided) {
        ++undecided;
        continue;
      }
      const double present = now.visibility.at(x, y);
      const double expected = weights > 0.0 ? kAlpha * present + (1.0 - kAlpha) * sum / weights : present;
      // The place is known to 1e-4 px (motion_test.cpp); between pixels visibility changes by 1 at most, and
      // little weight among those that count (0.01 at least) magnifies that.
      ASSERT_NEAR(product.visibility.at(x, y), expected, 1e-4 / std::min(1.0, std::max(weights, 0.01)) + 1e-5)
          << x << " " << y;
      ++compared;
      withoutPast += weights == 0.0;
    }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(withoutPast, 20);
  EXPECT_LT(undecided, compared / 10);
}

TEST_F(VisibilityHistoryTest, CountsWhoHasAPast) {
  const scene::Scene scene = withMovingCamera(makeScene("two_boxes"));
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, kHistoryPx);
  const auto averaged = make("soft_shadows/history", withMaps("soft_shadows/history", 128,
                                                              {{"clamp", std::string("neighbourhood")}}));
  averaged->prepare(frame);
  const auto counter = [&](const std::string& name) {
    for (const Counter& counted : averaged->count(frame))
      if (counted.name == name) return counted.value;
    ADD_FAILURE() << "no counter " << name;
    return 0.0;
  };
  show(frame, *averaged, 0.0);
  // The same view once more: every receiver finds itself, within its own neighbourhood.
  EXPECT_EQ(counter("history_taken_share"), 1.0);
  EXPECT_EQ(counter("history_bounded_share"), 0.0);
  frame.setTime(1.0);
  EXPECT_LT(counter("history_taken_share"), 1.0);
}

}  // namespace
}  // namespace limen::techniques
