// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "perception/threshold_maps/reference.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class ThresholdMapTechniqueTest : public TechniqueTest {
 protected:
  static std::string text(const char* value) { return value; }

  static double largestRelative(const Image& test, const Image& reference) {
    double largest = 0.0;
    for (size_t i = 0; i < test.data.size(); ++i)
      largest = std::max(largest, double{std::abs(test.data[i] / reference.data[i] - 1.0F)});
    return largest;
  }
};

TEST_F(ThresholdMapTechniqueTest, AgreesWithTheReferenceOnARendering) {
  const scene::Scene scene = makeScene("two_boxes");
  for (const char* decomposition : {"stack", "pyramid"}) {
    const Given given = {{"thresholds", text("single")},
                         {"thresholds.decomposition", text(decomposition)},
                         {"shading.shadow", true}};
    const Image reference = render(scene, "perception/threshold_map_reference", given, {150, 97}).product;
    for (const int64_t precision : {32, 16}) {
      Given own = given;
      own["thresholds.gpu.precision"] = precision;
      const Image map = render(scene, "perception/threshold_map", own, {150, 97}).product;
      // 0.5 % and a step of the TVI of 0.72 %, on which rounding puts a pixel to either side.
      EXPECT_LT(largestRelative(map, reference), precision == 16 ? 0.02 : 0.0123) << precision;
    }
  }
}

TEST_F(ThresholdMapTechniqueTest, BandsAgreeWithTheirReferenceOnARendering) {
  const scene::Scene scene = makeScene("two_boxes");
  for (const bool one : {false, true}) {
    Given given = {{"shading.shadow", true}};
    if (one) given["thresholds.output"] = text("band");
    const Image reference = render(scene, "perception/threshold_map_reference", given, {150, 97}).product;
    EXPECT_LT(largestRelative(render(scene, "perception/threshold_map", given, {150, 97}).product, reference),
              0.005)
        << one;
  }
}

TEST_F(ThresholdMapTechniqueTest, ABackgroundAloneIsAFlatField) {
  // A linear grey of 0.5 between 0.5 and 250 cd/m2 is 125.25; on Ward's last branch tvi = 10^-1.255 L.
  const scene::Scene scene = makeScene("two_boxes");
  const Given given = {{"thresholds", text("single")},
                       {"shading.ambient", 0.0},
                       {"shading.diffuse", 0.0},
                       {"shading.background", 0.0},
                       {"shading.pattern", false}};
  // A black frame: 0.5 cd/m2 everywhere, Ward's fourth branch.
  const Image map = render(scene, "perception/threshold_map", given, {40, 30}).product;
  const double expected = 0.2 * std::pow(10.0, std::log10(0.5) - 0.395);
  for (const float value : map.data) EXPECT_NEAR(value / expected, 1.0, 1e-4);
}

TEST_F(ThresholdMapTechniqueTest, FollowsTheViewingDistance) {
  // The reference's pixels per degree double with the distance.
  const scene::Scene scene = makeScene("two_boxes");
  const auto ppd = [&](double distanceM) {
    return render(scene, "perception/threshold_map_reference", {{"display.distance_m", distanceM}}, {32, 24},
                  true)
        .counter("pixels_per_degree");
  };
  EXPECT_NEAR(ppd(1.2) / ppd(0.6), 2.0, 1e-9);
}

TEST_F(ThresholdMapTechniqueTest, CountsWhatItDeclares) {
  const scene::Scene scene = makeScene("two_boxes");
  for (const char* name : {"perception/threshold_map", "perception/threshold_map_reference"})
    for (const char* kind : {"bands", "single"}) {
      const TechniqueInfo& info = TechniqueRegistry::instance().get(name);
      const Rendered rendered = render(scene, name, {{"thresholds", text(kind)}}, {64, 48}, true);
      EXPECT_EQ(rendered.counters.size(), info.counters.size());
      for (const Quantity& counter : info.counters) EXPECT_GE(rendered.counter(counter.name), 0.0);
      EXPECT_EQ(toText(info.product), "threshold");
    }
  const Rendered rendered =
      render(scene, "perception/threshold_map", {{"thresholds", text("single")}}, {64, 64}, true);
  EXPECT_EQ(rendered.counter("gaussian_levels"), 7.0);
  // Read 16 of colour, write 4, write and read luminance, write level 1 and read it twice: a quarter of 12;
  // and twice a quarter of 2 for what its rounding took away.
  EXPECT_NEAR(rendered.counter("bytes_moved_per_px"), 16 + 4 + 8 + 3 * (1 + 0.25 + 0.0625 + 0.02) + 1, 0.02);
}

}  // namespace
}  // namespace limen::techniques
