// SPDX-License-Identifier: BSD-3-Clause
// Split passes, in which several invocations share the loop over a pixel's micro-occluders, against the
// single pass.
#include <bit>
#include <cmath>
#include <cstring>

#include "renderer/techniques/soft_shadows/pixel_counts.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char *kBitmask = "soft_shadows/bitmask", *kArea = "soft_shadows/backprojection",
                     *kColoured = "soft_shadows/bitmask_coloured";

class SharedLoops : public TechniqueTest {
 protected:
  static ParameterValue text(const char* value) { return std::string(value); }
  static Given with(Given given, const Given& more) {
    for (const auto& [name, value] : more) given[name] = value;
    return given;
  }
  static Given split(int64_t lanes) {
    return {{"passes", text("split")}, {"passes.smoothing", text("none")}, {"passes.lanes", lanes}};
  }

  struct Result {
    std::vector<float> product;
    PixelCounts counted;
  };
  /// Two frames, since what one leaves behind is no concern of the next.
  static Result find(const scene::Scene& scene, const char* technique, Given given) {
    given.emplace("resolution", int64_t{128});
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const ParameterValues values(info.parameters, given);
    if (info.check) info.check(values);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {61, 45});
    const auto made = info.make(values);
    made->prepare(frame);
    for (int i = 0; i < 2; ++i) {
      frame.begin();
      made->render(frame);
      frame.end();
    }
    Result out{made->product().read().data, {}};
    made->count(frame);
    out.counted = dynamic_cast<const CountsPixels&>(*made).counted();
    EXPECT_EQ(std::memcmp(out.product.data(), made->product().read().data.data(),
                          out.product.size() * sizeof(float)),
              0)
        << "counting changes the product";
    return out;
  }

  static void expectSameBits(const scene::Scene& scene, const char* technique, const Given& given,
                             const std::string& what, std::initializer_list<int64_t> lanes = {8}) {
    const Result single = find(scene, technique, with(given, {{"passes", text("single")}}));
    size_t processed = 0, partly = 0;
    for (size_t i = 0; i < single.counted.work.size(); i += 4)
      processed += single.counted.work[i] == Processed;
    for (const float value : single.product) partly += value > 0.0F && value < 1.0F;
    EXPECT_GT(processed, 50) << what;
    EXPECT_GT(partly, 50) << what;
    for (const int64_t each : lanes) {
      const Result shared = find(scene, technique, with(given, split(each)));
      ASSERT_EQ(shared.product.size(), single.product.size());
      size_t differing = 0;
      for (size_t i = 0; i < single.product.size(); ++i)
        differing += std::memcmp(&shared.product[i], &single.product[i], sizeof(float)) != 0;
      EXPECT_EQ(differing, 0U) << technique << ' ' << what << ", lanes " << each;
      // Classes, levels and areas; how much is left to look at once a mask is full depends on the order.
      for (size_t i = 0; i < single.counted.work.size(); i += 4) {
        ASSERT_EQ(shared.counted.work[i], single.counted.work[i]) << what << ' ' << i / 4;
        ASSERT_EQ(shared.counted.work[i + 3], single.counted.work[i + 3]) << what << ' ' << i / 4;
        ASSERT_EQ(shared.counted.search[i], single.counted.search[i]) << what << ' ' << i / 4;
        ASSERT_EQ(shared.counted.search[i + 3], single.counted.search[i + 3]) << what << ' ' << i / 4;
        if (single.product[std::min(i / 4, single.product.size() - 1)] == 0.0F || each == 1) continue;
        // Of two levels, one may be full.
        const auto level = std::bit_cast<float>(single.counted.search[i + 3]);
        if (technique != std::string(kBitmask) || level != std::floor(level)) continue;
        for (const size_t channel : {1, 2})
          ASSERT_EQ(shared.counted.search[i + channel], single.counted.search[i + channel]) << what;
      }
    }
  }
};

TEST_F(SharedLoops, MasksOfAllOccludersHaveTheBitsOfTheSinglePass) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const char* depths : {"sampled", "nearest"})
    for (const char* fill : {"none", "left_bottom", "diagonal"})
      expectSameBits(scene, kBitmask,
                     {{"occluders.depths", text(depths)}, {"occluders.gap_fill", text(fill)}},
                     std::string(depths) + ' ' + fill);
  for (const char* occluders : {"microquads", "microquads_microtris", "microrects"})
    expectSameBits(scene, kBitmask, {{"occluders", text(occluders)}}, occluders);
  expectSameBits(scene, kBitmask,
                 {{"occluders", text("microquads_microtris")}, {"occluders.mask", text("half_space_table")}},
                 "half-space table");
}

// How the cells are shared out does not depend on what is found in each of them.
TEST_F(SharedLoops, AnyNumberOfLanesHasTheBitsOfTheSinglePass) {
  const scene::Scene scene = makeScene("sphere_grid");
  expectSameBits(scene, kBitmask, {{"occluders.gap_fill", text("diagonal")}}, "micropatches",
                 {1, 2, 4, 8, 16});
  expectSameBits(scene, kBitmask, {{"occluders", text("microquads_microtris")}}, "microtriangles",
                 {1, 8, 16});
}

TEST_F(SharedLoops, MasksOfAllPatternsHaveTheBitsOfTheSinglePass) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const char* pattern : {"regular_16", "regular_32", "halton_256"})
    expectSameBits(scene, kBitmask, {{"pattern", text(pattern)}}, pattern);
  // The shortest mask and the longest.
  for (const char* pattern : {"regular_8", "random_1024"})
    expectSameBits(scene, kBitmask, {{"pattern", text(pattern)}}, pattern, {2, 8});
}

TEST_F(SharedLoops, BiasesLevelsAndBudgetsHaveTheBitsOfTheSinglePass) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const char* bias : {"receiver_slope", "constant", "per_level"})
    expectSameBits(scene, kBitmask, {{"bias", text(bias)}}, bias);
  expectSameBits(scene, kBitmask, {{"bias", text("stored")}, {"occluders.depths", text("nearest")}},
                 "stored bias");
  // Of a budget of 4 cells use one, which hides all of the light or nothing.
  for (const int64_t budget : {0, 9, 37, 1024})
    for (const char* division : {"levels", "cells"})
      expectSameBits(scene, kBitmask, {{"budget.limit", budget}, {"occluders.division", text(division)}},
                     "budget " + std::to_string(budget) + ", " + division);
  for (const char* levels : {"coarsest_over", "narrow_blend", "dither"})
    expectSameBits(scene, kBitmask, {{"levels", text(levels)}, {"budget.limit", int64_t{36}}}, levels);
  // Two levels in turn.
  expectSameBits(scene, kBitmask, {{"levels", text("blend")}, {"budget.limit", int64_t{36}}}, "blend",
                 {1, 4, 8});
  for (const char* budget : {"radial", "masking", "perceptual"})
    expectSameBits(scene, kBitmask, {{"budget", text(budget)}}, budget);
  expectSameBits(scene, kBitmask, {{"levels", text("fixed")}, {"levels.level", int64_t{2}}}, "fixed level");
}

TEST_F(SharedLoops, SeveralMapsHaveTheBitsOfTheSinglePass) {
  const scene::Scene scene = makeScene("two_boxes", {{"light_size", 3.0}});
  for (const Given& maps : {Given{{"maps", text("peeled")}, {"maps.layers", int64_t{3}}},
                            Given{{"maps", text("peeled")}, {"maps.passes", text("one")}},
                            Given{{"maps", text("light_points")}, {"maps.points", int64_t{5}}},
                            Given{{"maps", text("per_object")}}})
    expectSameBits(scene, kBitmask, maps, std::get<std::string>(maps.at("maps")));
  expectSameBits(scene, kBitmask, {{"maps", text("peeled")}}, "peeled", {1});
  expectSameBits(scene, kColoured, {}, "coloured", {1, 8});
  expectSameBits(scene, kColoured, {{"maps", text("peeled")}}, "coloured, peeled");
  expectSameBits(scene, kColoured, {{"maps", text("peeled")}, {"maps.passes", text("one")}},
                 "coloured, peeled, in one pass");
}

TEST_F(SharedLoops, LightsOfOtherShapesHaveTheBitsOfTheSinglePass) {
  expectSameBits(makeScene("sphere_grid", {{"light_shape", text("disc")}}), kBitmask, {}, "disc");
}

// Each invocation adds up its own areas, then all sums are added: n areas of the sum A differ from the single
// pass's by less than 2^-23 n A, and a visibility above 0 has A < 1.
TEST_F(SharedLoops, AreasDifferByTheRoundingOfTheirOrder) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const char* occluders : {"micropatches", "microquads_microtris", "microrects", "contours"}) {
    const Given given = {{"occluders", text(occluders)}};
    const Result single = find(scene, kArea, with(given, {{"passes", text("single")}}));
    for (const int64_t lanes : {1, 16}) {
      const Result shared = find(scene, kArea, with(given, split(lanes)));
      double most = 0.0, bound = 0.0;
      for (size_t i = 0; i < single.product.size(); ++i) {
        const double count =
            4.0 * single.counted.work[4 * i + 1] + 16.0;  // pieces of contours have both signs
        const double difference = std::abs(double{shared.product[i]} - double{single.product[i]});
        most = std::max(most, difference);
        bound = std::max(bound, std::ldexp(count, -23));
        ASSERT_LE(difference, std::ldexp(count, -23)) << occluders << ' ' << lanes << ' ' << i;
      }
      if (lanes == 1) {
        EXPECT_EQ(most, 0.0) << occluders;
      }
    }
  }
}

}  // namespace
}  // namespace limen::techniques
