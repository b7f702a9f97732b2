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

/// Unless a setting says otherwise, half of the budget.
TEST_F(SearchCellsTest, UseHalfOfTheBudgetByDefault) {
  const scene::Scene scene = makeScene("sphere_grid");
  Given given = cells(256), half = cells(256, {{"occluders.division.share", 0.5}});
  given.erase("occluders.division.share");
  EXPECT_EQ(differing(render(scene, kBitmask, given, {61, 45}).product,
                      render(scene, kBitmask, half, {61, 45}).product),
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
  EXPECT_TRUE(refusal(kBitmask, cells(64, {{"occluders.depths", std::string("nearest")}})));
  EXPECT_TRUE(refusal(kBitmask, cells(64, {{"levels", std::string("blend")}})));
  EXPECT_TRUE(refusal(kBitmask, cells(64, {{"bias", std::string("receiver_slope")}})));
}

}  // namespace
}  // namespace limen::techniques
