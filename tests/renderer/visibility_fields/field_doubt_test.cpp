// SPDX-License-Identifier: BSD-3-Clause
// Rays about which fields are in doubt, traced one by one: against the same rays all traced.
#include <algorithm>
#include <string>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"
#include "tests/renderer/visibility_fields/two_balls.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kDoubtPx{40, 30};
constexpr const char *kDoubtField = "visibility_fields/ambient_occlusion",
                     *kDoubtTraced = "visibility_fields/traced_occlusion";

class FieldDoubtTest : public TechniqueTest {
 protected:
  static Given rays() {
    return {{"rays", int64_t{256}}, {"radius", 10.0}, {"objects", std::string("parts")}};
  }
  static Given with(Given given, const Given& more) {
    for (const auto& [path, value] : more) given[path] = value;
    return given;
  }
  static Given doubtful(double reach, double footprints = 0.0) {
    return {{"combine.near", std::string("doubtful")},
            {"combine.near.reach", reach},
            {"combine.near.footprints", footprints},
            {"combine.near.capacity", 1.0}};
  }
};

// With nothing to compare no ray is in doubt, and the picture is that of the field alone. The farther apart
// the compared rays are the more are in doubt, and the fewer of those that are not err.
TEST_F(FieldDoubtTest, TheFartherDoubtReachesTheMoreIsTracedAndTheLessErrs) {
  const scene::Scene scene = twoBallsOverGround();
  const Image exact = render(scene, kDoubtTraced, rays(), kDoubtPx).product;
  const Given coarse = with(rays(), {{"positions", int64_t{1090}}, {"directions", int64_t{32}}});
  const Image looked =
      render(scene, kDoubtField, with(coarse, {{"combine.near", std::string("field")}}), kDoubtPx).product;
  double before = meanDifference(looked, exact), shareBefore = 0.0;
  const double alone = before;
  ASSERT_GT(alone, 0.0);
  for (const double reach : {0.0, 0.5, 1.0, 2.0}) {
    const Rendered found = render(scene, kDoubtField, with(coarse, doubtful(reach)), kDoubtPx, true);
    EXPECT_EQ(found.counter("doubtful_overflow"), 0.0);
    const double error = meanDifference(found.product, exact), share = found.counter("doubtful_ray_share");
    if (reach == 0.0) {
      // Sums of other orders.
      EXPECT_LT(meanDifference(found.product, looked), 1e-6);
      EXPECT_EQ(share, 0.0);
    } else {
      EXPECT_LT(error, 0.7 * before) << reach;
      EXPECT_GT(share, shareBefore) << reach;
    }
    before = error, shareBefore = share;
  }
  // A stored ray passes a ray that is asked for by up to 0.7 of the distance between positions, 0.107 radii,
  // where it enters and leaves the sphere, and by half a texel: less than two texels, 0.055 each at a radius,
  // unless it meets a ball soon after it enters, where texels are closer.
  EXPECT_LT(before, 0.05 * alone);
}

// Silhouettes take few rays: less than those within two texels, 0.055, of the outlines of balls in a sphere
// of 0.91, at most 4 pi 0.3 / 0.91 long, of the half space's unit disc in which a sphere seen at 1.1 or more
// has a radius below 0.83: 4.1 * 0.83 * 2 * 0.055 / pi.
TEST_F(FieldDoubtTest, FewRaysAreTraced) {
  const Given fine = with(rays(), {{"positions", int64_t{4226}}, {"directions", int64_t{64}}});
  const Rendered found = render(twoBallsOverGround(), kDoubtField, with(fine, doubtful(1.0)), kDoubtPx, true);
  EXPECT_LT(found.counter("doubtful_ray_share"), 0.12);
  EXPECT_GT(found.counter("doubtful_ray_share"), 0.0);
}

// Which rays would be left out depends on the order in which they came, so that none is traced.
TEST_F(FieldDoubtTest, AListThatIsTooShortLeavesAllToTheFieldAndSaysSo) {
  const scene::Scene scene = twoBallsOverGround();
  const Given coarse = with(rays(), {{"positions", int64_t{290}}, {"directions", int64_t{32}}});
  const Image looked =
      render(scene, kDoubtField, with(coarse, {{"combine.near", std::string("field")}}), kDoubtPx).product;
  Given given = with(coarse, doubtful(1.0));
  given["combine.near.capacity"] = 0.002;
  const Rendered found = render(scene, kDoubtField, given, kDoubtPx, true);
  EXPECT_EQ(found.counter("doubtful_overflow"), 1.0);
  EXPECT_GT(found.counter("doubtful_ray_share"), 0.002);
  // Units of 2^-20 of a ray.
  EXPECT_LT(meanDifference(found.product, looked), 1e-5);
}

TEST_F(FieldDoubtTest, IsTheSameInEveryRun) {
  const scene::Scene scene = twoBallsOverGround();
  const Given given = with(with(rays(), doubtful(1.0, 0.5)), {{"positions", int64_t{290}}});
  const Image first = render(scene, kDoubtField, given, kDoubtPx).product;
  EXPECT_EQ(meanDifference(first, render(scene, kDoubtField, given, kDoubtPx).product), 0.0);
}

// Two parts, and falloffs that let light through by distance: neighbours that differ by less than is asked
// for may do so, and no ray errs by more than a field does. Light that is let through by distance is traced
// to the nearest.
TEST_F(FieldDoubtTest, OfSeveralObjectsTheNearestCounts) {
  scene::Scene scene = twoBallsOverGround();
  scene::addPart(scene, "box", scene::box({-0.9, 0.6, -0.3}, {0.2, 0.7, 0.3}), glm::vec3(0.5F));
  for (const char* falloff : {"binary", "linear"}) {
    const Given near =
        with(rays(), {{"rays", int64_t{64}}, {"radius", 0.1}, {"falloff", std::string(falloff)}});
    const Given fine = with(near, {{"positions", int64_t{1090}}, {"directions", int64_t{64}}});
    const Image exact = render(scene, kDoubtTraced, near, kDoubtPx).product;
    const double alone = meanDifference(
        render(scene, kDoubtField, with(fine, {{"combine.near", std::string("field")}}), kDoubtPx).product,
        exact);
    const double error =
        meanDifference(render(scene, kDoubtField, with(fine, doubtful(2.0, 0.5)), kDoubtPx).product, exact);
    EXPECT_LT(error, 0.25 * alone) << falloff;
  }
}

// A box is convex: nothing of it is dark. Rays that start on it are in doubt where slack does not tell them
// from what blocks, and are traced; none of the others is darker than the field alone makes it.
TEST_F(FieldDoubtTest, AConvexObjectDoesNotOccludeItself) {
  scene::Scene scene;
  scene::addPart(scene, "box", scene::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), glm::vec3(0.5F));
  scene::setStillCamera(scene, scene::orbitCamera({0.0, 0.0, 0.0}, 3.0, 30.0, 30.0));
  const Given given =
      with({{"rays", int64_t{64}}, {"radius", 10.0}, {"positions", int64_t{1090}}}, doubtful(1.0, 0.5));
  const Image found = render(scene, kDoubtField, given, kDoubtPx).product;
  const Image exact =
      render(scene, kDoubtTraced, {{"rays", int64_t{64}}, {"radius", 10.0}}, kDoubtPx).product;
  EXPECT_LT(meanDifference(found, exact), 1e-3);
}

TEST_F(FieldDoubtTest, SilhouettesOfShadowsAreTraced) {
  const scene::Scene scene = twoBallsOverGround();
  const char *field = "visibility_fields/soft_shadows", *traced = "visibility_fields/traced_shadows";
  const auto differs = [](const Image& a, const Image& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) sum += std::abs(double(a.data[i]) - b.data[i]);
    return sum;
  };
  const Image exact = render(scene, traced, {{"rays", int64_t{64}}}, kDoubtPx).product;
  Given given = {{"rays", int64_t{64}},
                 {"positions", int64_t{4226}},
                 {"directions", int64_t{64}},
                 {"objects", std::string("parts")}};
  const double alone = differs(render(scene, field, given, kDoubtPx).product, exact);
  given.insert({{"near", std::string("doubtful")}, {"near.reach", 2.0}, {"near.capacity", 1.0}});
  const Rendered found = render(scene, field, given, kDoubtPx, true);
  EXPECT_EQ(found.counter("doubtful_overflow"), 0.0);
  EXPECT_LT(differs(found.product, exact), 0.1 * alone);
}

TEST_F(FieldDoubtTest, NeedsNeighboursOfAimedLookUps) {
  EXPECT_TRUE(refusal(kDoubtField, with(doubtful(1.0), {{"fetch", std::string("nearest")}})));
  EXPECT_TRUE(refusal(kDoubtField, with(doubtful(1.0), {{"direction_map", std::string("polar")}})));
  EXPECT_FALSE(refusal(kDoubtField, with(doubtful(1.0), {{"fetch", std::string("all")}})));
}

}  // namespace
}  // namespace limen::techniques
