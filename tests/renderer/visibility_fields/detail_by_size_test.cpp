// SPDX-License-Identifier: BSD-3-Clause
// Fields as fine as an error allows: against the same rays traced, along a path of distances.
#include "renderer/techniques/visibility_fields/detail_by_size.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

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

// One form for each object: beside a field of the finest form everywhere the picture changes by no more than
// the error.
TEST_F(DetailBySizeTest, EachObjectHasItsOwnForm) {
  constexpr double kError = 0.1;
  scene::Scene scene = seenFrom(4.0);
  for (const double x : {-9.0, -4.0, 9.0}) {
    scene::Mesh far = scene::box({x, 0.0, -30.0}, {x + 0.8, 1.2, -29.5});
    scene::append(far, scene::box({x + 1.0, 0.0, -30.0}, {x + 1.2, 0.6, -29.0}));
    scene::addPart(scene, "far", far, glm::vec3(0.5F));
  }
  Given given = {{"rays", int64_t{64}}, {"objects", std::string("parts")}};
  const Image exact = render(scene, "visibility_fields/traced_occlusion", given, kDetailSizePx).product;
  given.insert(
      {{"positions", int64_t{4226}}, {"directions", int64_t{32}}, {"combine.near", std::string("field")}});
  const double givenMib =
      render(scene, "visibility_fields/ambient_occlusion", given, kDetailSizePx, true).counter("field_mib");
  given["storage.detail"] = std::string("by_size");
  given["storage.detail.error"] = kError;
  for (const char* fetch : {"nearest", "aimed", "all"}) {
    given["fetch"] = std::string(fetch);
    const Rendered found = render(scene, "visibility_fields/ambient_occlusion", given, kDetailSizePx, true);
    EXPECT_LT(rootMeanSquare(found.product, exact), kError) << fetch;
    EXPECT_GE(found.counter("field_forms"), 2.0);
    // Three of four objects have next to nothing.
    EXPECT_LT(found.counter("field_mib"), 0.5 * givenMib);
  }
}

// Of a sphere that stands in the middle of the view the rim's ray leaves the axis by asin(R / d).
TEST(ObjectSize, IsThatOfItsOutline) {
  scene::Camera camera;
  camera.eye = {0.0, 0.0, 4.0}, camera.verticalFovDeg = 60.0;
  const double expected = std::tan(std::asin(0.25)) * 50.0 / std::tan(glm::radians(30.0));
  EXPECT_NEAR(sizePx(camera, {100, 100}, {}), expected, 1e-9);
  camera.eye = {0.0, 0.0, 0.9};
  EXPECT_TRUE(std::isinf(sizePx(camera, {100, 100}, {})));
}

TEST(FormsBySize, AreTheFinestWhereNoneIsFineEnoughAndSayThatTheErrorIsNotKept) {
  visibility_fields::FieldForm finest;
  finest.positions = 1090, finest.directions = 32;
  const ChosenDetail chosen = formsBySize(finest, {1e6, 1e-9}, {64, 64}, 0.01);
  EXPECT_EQ(chosen.forms[0].positions, 1090);
  EXPECT_EQ(chosen.forms[0].directions, 32);
  EXPECT_EQ(chosen.forms[0].bits, 8);
  EXPECT_FALSE(chosen.kept());
  EXPECT_GT(chosen.bound, 0.01);
  const std::vector<std::string> remarks = detailRemarks(chosen, {"near", "far"});
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_NE(remarks[0].find("1090 x 32 x 32 of 8 bits for 'near'"), std::string::npos) << remarks[0];
  EXPECT_NE(remarks[1].find("0.01 asked for"), std::string::npos) << remarks[1];
}

TEST(FormsBySize, AreTheCoarsestForObjectsTooSmallToSee) {
  visibility_fields::FieldForm finest;
  finest.positions = 1090, finest.directions = 32;
  const ChosenDetail chosen = formsBySize(finest, {1e-6, 20.0}, {64, 64}, 0.2);
  EXPECT_EQ(chosen.forms[0].positions, 82);
  EXPECT_EQ(chosen.forms[0].bits, 1);
  EXPECT_GT(chosen.forms[1].positions, 82);
  EXPECT_TRUE(chosen.kept());
  EXPECT_EQ(chosen.formCount(), 2U);
  EXPECT_EQ(detailRemarks(chosen, {"a", "b"}).size(), 1U);
}

// Bounds of several objects add up as squares: of as many as alike the bound is the root of their number
// times that of one.
TEST(FormsBySize, BoundsAddUpAsSquares) {
  visibility_fields::FieldForm only;
  only.positions = 82, only.directions = 8, only.bits = 1;
  const double one = formsBySize(only, {3.0}, {64, 64}, 1e-9).bound;
  EXPECT_NEAR(formsBySize(only, std::vector<double>(9, 3.0), {64, 64}, 1e-9).bound, 3.0 * one, 1e-12);
  EXPECT_NEAR(one, boundBySize(only, 3.0, {64, 64}), 1e-12);
}

// No bound: the camera is within a sphere. The others are chosen all the same.
TEST(FormsBySize, WithinASphereThereIsNoBound) {
  visibility_fields::FieldForm finest;
  finest.positions = 1090, finest.directions = 32;
  const ChosenDetail chosen =
      formsBySize(finest, {std::numeric_limits<double>::infinity(), 1e-6}, {64, 64}, 0.05);
  EXPECT_EQ(chosen.forms[0].positions, 1090);
  EXPECT_EQ(chosen.forms[1].positions, 82);
  EXPECT_FALSE(chosen.kept());
  EXPECT_EQ(detailRemarks(chosen, {"a", "b"}).size(), 2U);
}

}  // namespace
}  // namespace limen::techniques
