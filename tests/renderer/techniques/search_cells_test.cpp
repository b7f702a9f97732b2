// SPDX-License-Identifier: BSD-3-Clause
// Search areas in cells of any size: what they have in common with texels of levels, how much of a budget
// they use, and that they do not depend on the form of the passes or the camera.
#include <cmath>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class SearchCellsTest : public TechniqueTest {
 protected:
  static constexpr const char* kBitmask = "soft_shadows/bitmask";
  static Given cells(int64_t budget, Given more = {}) {
    more["occluders.division"] = std::string("cells");
    more["budget.limit"] = budget;
    more.emplace("occluders.division.share", 1.0);
    more.emplace("resolution", int64_t{256});
    return more;
  }
  static Given levels(int64_t budget) {
    return {{"occluders.division", std::string("levels")},
            {"budget.limit", budget},
            {"resolution", int64_t{256}}};
  }
  static double meanSquare(const Image& a, const Image& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) sum += std::pow(double(a.data[i]) - double(b.data[i]), 2);
    return sum / static_cast<double>(a.data.size());
  }
  static size_t differing(const Image& a, const Image& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.data.size(); ++i) count += a.data[i] != b.data[i];
    return count;
  }
};

/// Without a limit every cell is one texel, as is every texel of level 0.
TEST_F(SearchCellsTest, WithoutALimitAreTheMapsTexels) {
  const scene::Scene scene = makeScene("two_boxes");
  for (const char* fill : {"none", "left_bottom", "diagonal"}) {
    Given cell = cells(0, {{"occluders.division.least_width", 0.0}}), level = levels(0);
    cell["occluders.gap_fill"] = level["occluders.gap_fill"] = std::string(fill);
    const Image a = render(scene, kBitmask, cell, {64, 48}).product;
    const Image b = render(scene, kBitmask, level, {64, 48}).product;
    // A cell's edge may round to the other side of a sample of the light.
    EXPECT_LE(differing(a, b), a.data.size() / 1000) << fill;
    EXPECT_LT(meanSquare(a, b), 1e-6) << fill;
  }
}

/// Never more than a budget. Sides of powers of two leave an axis of a large area with between half of its
/// share and all of it, cells with all of it.
TEST_F(SearchCellsTest, UseMoreOfABudgetThanLevels) {
  const scene::Scene scene = makeScene("sphere_grid");
  constexpr int64_t kBudget = 36;
  Given fine = cells(kBudget), coarse = levels(kBudget);
  fine["resolution"] = coarse["resolution"] = int64_t{1024};
  const Rendered a = render(scene, kBitmask, fine, {64, 48}, true),
                 b = render(scene, kBitmask, coarse, {64, 48}, true);
  EXPECT_LE(a.counter("examined_per_px"), double(kBudget));
  EXPECT_GT(a.counter("examined_per_px"), b.counter("examined_per_px"));
}

/// A share s of n x n cells is sqrt(s) n on each axis, rounded down, but one at least.
TEST_F(SearchCellsTest, UseAShareOfTheBudget) {
  const scene::Scene scene = makeScene("sphere_grid");
  const auto of = [&](int64_t budget, double share) {
    return render(scene, kBitmask, cells(budget, {{"occluders.division.share", share}}), {61, 45}).product;
  };
  EXPECT_EQ(differing(of(256, 0.25), of(64, 1.0)), 0U);
  EXPECT_EQ(differing(of(256, 0.5), of(121, 1.0)), 0U);
  EXPECT_EQ(differing(of(100, 0.36), of(36, 1.0)), 0U);
  EXPECT_EQ(differing(of(4, 0.1), of(1, 1.0)), 0U);
  EXPECT_EQ(differing(of(0, 0.5), of(0, 1.0)), 0U) << "no limit";
  EXPECT_GT(differing(of(256, 0.25), of(256, 1.0)), 0U);
}

/// The cell around the receiver reads the receiver's own texel. A single cell is as wide as the area, which
/// the nearest depth in it throws onto all of the light, farther ones wider: but for areas that the map's
/// border cuts, all of the light or nothing is hidden, as by a hard shadow. No structure: a depth range could
/// find a receiver lit or dark without a look at its texel.
TEST_F(SearchCellsTest, OneCellIsAHardShadow) {
  for (const char* name : {"two_boxes", "sphere_grid"}) {
    const scene::Scene scene = makeScene(name);
    const Given given =
        cells(1, {{"occluders.gap_fill", std::string("none")}, {"structure", std::string("none")}});
    const Image one = render(scene, kBitmask, given, {96, 72}).product,
                hard = render(scene, "soft_shadows/hard", {{"resolution", int64_t{256}}}, {96, 72}).product,
                rays = render(scene, "soft_shadows/ray_traced", {{"samples", int64_t{64}}}, {96, 72}).product;
    size_t dark = 0, different = 0;
    for (size_t i = 0; i < hard.data.size(); ++i) {
      dark += hard.data[i] == 0.0F;
      // Light behind the receiver's plane is hidden from masks besides.
      different += hard.data[i] == 0.0F ? one.data[i] == 1.0F : one.data[i] == 0.0F && rays.data[i] > 0.0F;
    }
    EXPECT_GT(dark, 300U) << name;
    EXPECT_EQ(different, 0U) << name;
  }
}

/// Unless a setting says otherwise, 0.6 of the budget: of 16 x 16, the whole part of 12.4 squared.
TEST_F(SearchCellsTest, UseThreeFifthsOfTheBudgetByDefault) {
  const scene::Scene scene = makeScene("sphere_grid");
  Given given = cells(256), all = cells(144);
  given.erase("occluders.division.share");
  EXPECT_EQ(differing(render(scene, kBitmask, given, {61, 45}).product,
                      render(scene, kBitmask, all, {61, 45}).product),
            0U);
}

TEST_F(SearchCellsTest, ErrLessThanLevelsOfTheSameBudget) {
  for (const char* name : {"palm", "street_light", "columns_hall"}) {
    const scene::Scene scene = makeScene(name);
    const glm::ivec2 sizePx(96, 72);
    const Image exact = render(scene, "soft_shadows/ray_traced", {{"samples", int64_t{256}}}, sizePx).product;
    Given fine = cells(64), coarse = levels(64);
    fine["resolution"] = coarse["resolution"] = int64_t{1024};
    EXPECT_LT(meanSquare(render(scene, kBitmask, fine, sizePx).product, exact),
              meanSquare(render(scene, kBitmask, coarse, sizePx).product, exact))
        << name;
  }
}

TEST_F(SearchCellsTest, AreTheSameInSplitPasses) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Image single =
      render(scene, kBitmask, cells(64, {{"passes", std::string("single")}}), {61, 45}).product;
  for (const int64_t lanes : {1, 4, 8}) {
    const Image split =
        render(scene, kBitmask, cells(64, {{"passes", std::string("split")}, {"passes.lanes", lanes}}),
               {61, 45})
            .product;
    EXPECT_EQ(differing(single, split), 0U) << lanes;
  }
}

/// The same camera, upside down, sees each point in the opposite pixel. Rounding moves points by some 1e-7 of
/// their distance, which can tip a sample of the light over an occluder's edge; a choice of texels that
/// depended on the picture would change most of the penumbra.
TEST_F(SearchCellsTest, DoNotDependOnTheCamera) {
  scene::Scene scene = makeScene("columns_hall");
  const glm::ivec2 sizePx(64, 48);
  Given given = cells(64);
  given["resolution"] = int64_t{512};
  const Image upright = render(scene, kBitmask, given, sizePx).product;
  for (auto& key : scene.camera.keys) key.camera.up = -key.camera.up;
  const Image upsideDown = render(scene, kBitmask, given, sizePx).product;
  size_t penumbra = 0, changed = 0;
  for (int y = 0; y < sizePx.y; ++y)
    for (int x = 0; x < sizePx.x; ++x) {
      const float a = upright.at(x, y), b = upsideDown.at(sizePx.x - 1 - x, sizePx.y - 1 - y);
      penumbra += a > 0.0F && a < 1.0F;
      changed += std::abs(a - b) > 1.0F / 64.0F;
    }
  EXPECT_GT(penumbra, 200U);
  EXPECT_LT(static_cast<double>(changed), 0.02 * static_cast<double>(penumbra));
}

/// Of a budget for each pixel, too.
TEST_F(SearchCellsTest, FollowABudgetMap) {
  const scene::Scene scene = makeScene("sphere_grid");
  Given given = cells(64);
  given.erase("budget.limit");
  given["budget"] = std::string("radial");
  given["budget.centre"] = given["budget.rim"] = int64_t{64};
  for (const char* passes : {"single", "split"}) {
    Given uniform = cells(64);
    given["passes"] = uniform["passes"] = std::string(passes);
    EXPECT_EQ(differing(render(scene, kBitmask, given, {61, 45}).product,
                        render(scene, kBitmask, uniform, {61, 45}).product),
              0U)
        << passes;
  }
}

TEST_F(SearchCellsTest, RefuseWhatOnlyLevelsHave) {
  EXPECT_FALSE(refusal(kBitmask, cells(64)));
  for (const char* depths : {"nearest", "centre", "median"})
    EXPECT_TRUE(refusal(kBitmask, cells(64, {{"occluders.depths", std::string(depths)}}))) << depths;
  EXPECT_TRUE(refusal(kBitmask, cells(64, {{"levels", std::string("blend")}})));
  EXPECT_TRUE(refusal(kBitmask, cells(64, {{"bias", std::string("receiver_slope")}})));
}

}  // namespace
}  // namespace limen::techniques
