// SPDX-License-Identifier: BSD-3-Clause
// The filter on visibility: what it does to the bands of a straight edge, and what it must leave alone.
#include <cmath>

#include "experiments/base/error.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char* kFiltered = "soft_shadows/bitmask";

class VisibilityFilterTest : public TechniqueTest {
 protected:
  /// Radius 0: no filter.
  static Given withFilter(int64_t resolution, int64_t radius) {
    Given given = {{"resolution", resolution}};
    if (radius > 0) {
      given["filter"] = std::string("surface_mean");
      given["filter.radius"] = radius;
    }
    return given;
  }
};

/// The edge is parallel to the light's rows of n samples: they vanish a row at a time, and visibility has
/// steps of 1/n. Over 2 r + 1 pixels in line it rises by what the reference does, and by no more than one row
/// on top: so much divided by 2 r + 1 is the step that is left after a mean over them.
TEST_F(VisibilityFilterTest, LeavesOfAStepWhatItsWidthAllows) {
  constexpr int kRadius = 4, kRows = 8;
  const scene::Scene scene = makeScene("half_plane");
  const auto productOf = [&](int64_t radius) {
    Given given = withFilter(64, radius);
    given["budget.limit"] = int64_t{0};
    given["pattern"] = std::string("regular_8");
    if (radius > 0) given["filter.step"] = 0.25;
    return render(scene, kFiltered, given, {96, 72}).product;
  };
  const Rendered truth = render(scene, "soft_shadows/exact_union", {}, {96, 72});
  const Image plain = productOf(0), filtered = productOf(kRadius);
  // Pixels whose neighbourhoods, of their neighbours too, lie on the ground.
  const auto onGround = [&](int x, int y) {
    if (truth.receivers.at(x, y, 3) < 0.0F) return false;
    const scene::AreaLight& light = scene.lights[0];
    const double height = light.centre.y + light.axisX.y * truth.receivers.at(x, y, 0) +
                          light.axisY.y * truth.receivers.at(x, y, 1) +
                          light.direction().y * truth.receivers.at(x, y, 2);
    return std::abs(height) < 1e-3;
  };
  double plainStep = 0.0, filteredExcess = 0.0;
  int evaluated = 0;
  constexpr int kMargin = kRadius + 1;
  for (int y = kMargin; y < plain.height - kMargin; ++y)
    for (int x = kMargin; x < plain.width - kMargin; ++x) {
      bool inside = true;
      double slope = 0.0;
      for (int j = -kMargin; j <= kMargin && inside; ++j)
        for (int i = -kMargin; i <= kMargin && inside; ++i) {
          inside = onGround(x + i, y + j);
          if (!inside || i == kMargin || j == kMargin) continue;
          const double here = truth.product.at(x + i, y + j);
          slope = std::max({slope, std::abs(truth.product.at(x + i + 1, y + j) - here),
                            std::abs(truth.product.at(x + i, y + j + 1) - here)});
        }
      if (!inside) continue;
      ++evaluated;
      for (const auto& [i, j] : {std::pair(1, 0), {0, 1}}) {
        plainStep = std::max(plainStep, std::abs(double(plain.at(x + i, y + j)) - plain.at(x, y)));
        filteredExcess =
            std::max(filteredExcess, std::abs(double(filtered.at(x + i, y + j)) - filtered.at(x, y)) - slope);
      }
    }
  EXPECT_GT(evaluated, 500);
  EXPECT_GE(plainStep, 1.0 / kRows - 1e-6);
  EXPECT_LE(filteredExcess, 1.0 / kRows / (2 * kRadius + 1) + 1e-6);
}

/// A hard shadow has steps that no row of samples makes; a filter that took them for bands would blur them.
TEST_F(VisibilityFilterTest, LeavesHardShadowsAlone) {
  const scene::Scene scene = makeScene("two_boxes", {{"light_size", 0.001}});
  const auto productOf = [&](int64_t radius) {
    return render(scene, kFiltered, withFilter(256, radius), {64, 48}).product;
  };
  const Image plain = productOf(0), filtered = productOf(4);
  int lit = 0, dark = 0;
  for (size_t i = 0; i < plain.pixels(); ++i) {
    // Between the two, a pixel may hold a shadow's edge.
    if (plain.data[i] != 0.0F && plain.data[i] != 1.0F) continue;
    EXPECT_NEAR(filtered.data[i], plain.data[i], 0.125);
    lit += plain.data[i] == 1.0F && filtered.data[i] == 1.0F;
    dark += plain.data[i] == 0.0F && filtered.data[i] == 0.0F;
  }
  EXPECT_GT(lit, 1000);
  EXPECT_GT(dark, 50);
}

/// What is not of one surface does not mix: the lit card keeps its light before its own shadow on the ground.
TEST_F(VisibilityFilterTest, StaysOnTheSurface) {
  const scene::Scene scene = makeScene("parallel_rectangle");
  const Rendered plain = render(scene, kFiltered, {{"resolution", int64_t{64}}}, {96, 72});
  const Image filtered = render(scene, kFiltered,
                                {{"resolution", int64_t{64}},
                                 {"filter", std::string("surface_mean")},
                                 {"filter.radius", int64_t{8}},
                                 {"filter.step", 1.0}},
                                {96, 72})
                             .product;
  // The card lies 1.3 m below the light, the ground 2 m.
  int top = 0;
  for (size_t i = 0; i < filtered.pixels(); ++i)
    if (plain.receivers.data[4 * i + 3] >= 0.0F && plain.receivers.data[4 * i + 2] < 1.31F) {
      ++top;
      EXPECT_EQ(filtered.data[i], 1.0F);
    }
  EXPECT_GT(top, 100);
}

TEST_F(VisibilityFilterTest, WithoutAFilterItsSettingsCannotBeWritten) {
  const TechniqueInfo& info = TechniqueRegistry::instance().get(kFiltered);
  for (const char* name : {"filter.step", "filter.plane_share", "filter.angle"})
    EXPECT_THROW(ParameterValues(info.parameters, {{name, 0.5}}), Error) << name;
}

}  // namespace
}  // namespace limen::techniques
