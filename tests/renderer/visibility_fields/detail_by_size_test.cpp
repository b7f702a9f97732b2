// SPDX-License-Identifier: BSD-3-Clause
// Fields as fine as an error allows: against the same rays traced, along a path of distances.
#include "renderer/techniques/visibility_fields/detail_by_size.h"

#include <cmath>
#include <string>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kDetailSizePx{64, 48};

class DetailBySizeTest : public TechniqueTest {
 protected:
  static double rootMeanSquare(const Image& a, const Image& b) {
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) sum += std::pow(double(a.at(x, y)) - b.at(x, y), 2);
    return std::sqrt(sum / (double(a.width) * a.height));
  }
};

/// Two boxes and a pole, one object, on the ground.
scene::Scene seenFrom(double distance) {
  scene::Scene scene;
  scene::addGround(scene, 64.0);
  scene::Mesh mesh = scene::box({-0.6, 0.0, -0.3}, {-0.1, 0.9, 0.3});
  scene::append(mesh, scene::box({0.2, 0.0, -0.4}, {0.6, 0.5, 0.2}));
  scene::append(mesh, scene::box({0.0, 0.0, 0.3}, {0.1, 1.1, 0.4}));
  scene::addPart(scene, "object", mesh, glm::vec3(0.5F));
  scene::setStillCamera(scene, scene::orbitCamera({0.0, 0.4, 0.0}, distance, 30.0, 35.0, 40.0));
  return scene;
}

TEST_F(DetailBySizeTest, TheErrorIsKeptOnAPathOfDistances) {
  constexpr double kError = 0.03;
  double before = 1e9, nearest = 0.0;
  for (const double distance : {2.5, 5.0, 10.0, 20.0, 40.0}) {
    const scene::Scene scene = seenFrom(distance);
    Given given = {{"rays", int64_t{64}}, {"objects", std::string("parts")}};
    const Image exact = render(scene, "visibility_fields/traced_occlusion", given, kDetailSizePx).product;
    given.insert({{"positions", int64_t{4226}}, {"directions", int64_t{32}}});
    given["storage.detail"] = std::string("by_size");
    given["storage.detail.error"] = kError;
    const auto found = render(scene, "visibility_fields/ambient_occlusion", given, kDetailSizePx, true);
    EXPECT_LT(rootMeanSquare(found.product, exact), kError) << distance;
    const double mib = found.counter("field_mib");
    EXPECT_LE(mib, before) << distance;
    before = mib;
    if (nearest == 0.0) nearest = mib;
  }
  // Far away next to nothing is kept: less than a hundredth.
  EXPECT_LT(before, 0.01 * nearest);
}

// Of a sphere that stands in the middle of the view the rim's ray leaves the axis by asin(R / d).
TEST(ObjectsSize, IsThatOfTheirOutlines) {
  visibility_fields::RigidObject object;
  object.sphere = {glm::dvec3(0.0), 1.0};
  scene::Camera camera;
  camera.eye = {0.0, 0.0, 4.0}, camera.verticalFovDeg = 60.0;
  const double expected = std::tan(std::asin(0.25)) * 50.0 / std::tan(glm::radians(30.0));
  EXPECT_NEAR(objectsSizePx(camera, {100, 100}, {object}), expected, 1e-9);
  EXPECT_NEAR(objectsSizePx(camera, {100, 100}, {object, object}), std::sqrt(2.0) * expected, 1e-9);
  camera.eye = {0.0, 0.0, 0.9};
  EXPECT_TRUE(std::isinf(objectsSizePx(camera, {100, 100}, {object})));
}

TEST(FormBySize, IsTheFinestWhereNoneIsFineEnough) {
  visibility_fields::FieldForm finest;
  finest.positions = 1090, finest.directions = 32;
  const visibility_fields::FieldForm close = formBySize(finest, 1e6, {64, 64}, 0.01);
  EXPECT_EQ(close.positions, 1090);
  EXPECT_EQ(close.directions, 32);
  EXPECT_EQ(close.bits, 8);
  const visibility_fields::FieldForm far = formBySize(finest, 1e-6, {64, 64}, 0.01);
  EXPECT_EQ(far.positions, 82);
  EXPECT_EQ(far.bits, 1);
}

}  // namespace
}  // namespace limen::techniques
