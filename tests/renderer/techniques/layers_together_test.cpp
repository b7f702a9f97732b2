// SPDX-License-Identifier: BSD-3-Clause
// Layers of a peeled map read by one pass, with their masks joined in registers, against a pass for each
// layer whose masks are joined in an image.
#include <cstring>

#include "renderer/techniques/soft_shadows/pixel_counts.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class LayersTogether : public TechniqueTest {
 protected:
  static ParameterValue text(const char* value) { return std::string(value); }

  struct Result {
    std::vector<float> product;
    PixelCounts counted;
    double maskBytes = 0.0;
  };
  static Result find(const scene::Scene& scene, Given given, const char* passes) {
    given["maps.passes"] = text(passes);
    const TechniqueInfo& info = TechniqueRegistry::instance().get("soft_shadows/bitmask");
    const ParameterValues values(info.parameters, given);
    info.check(values);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {61, 45});
    const auto technique = info.make(values);
    technique->prepare(frame);
    // Two frames, since what one leaves behind is no concern of the next.
    for (int i = 0; i < 2; ++i) {
      frame.begin();
      technique->render(frame);
      frame.end();
    }
    Result out{technique->product().read().data, {}};
    for (const Counter& counter : technique->count(frame))
      if (counter.name == "mask_bytes") out.maskBytes = counter.value;
    EXPECT_EQ(std::memcmp(out.product.data(), technique->product().read().data.data(),
                          out.product.size() * sizeof(float)),
              0)
        << "counting changes the product";
    out.counted = dynamic_cast<const CountsPixels&>(*technique).counted();
    return out;
  }

  static void expectSameBits(const scene::Scene& scene, Given given, const std::string& what) {
    given.emplace("resolution", int64_t{128});
    given["maps"] = text("peeled");
    const Result together = find(scene, given, "one"), apart = find(scene, given, "each");
    EXPECT_EQ(together.maskBytes, 0.0) << what;
    EXPECT_GT(apart.maskBytes, 0.0) << what;
    ASSERT_EQ(together.product.size(), apart.product.size());
    size_t differing = 0, processed = 0, partly = 0;
    for (size_t i = 0; i < together.product.size(); ++i) {
      differing += std::memcmp(&together.product[i], &apart.product[i], sizeof(float)) != 0;
      const float visibility = apart.product[i];
      partly += visibility > 0.0F && visibility < 1.0F;
      const uint32_t *ours = &together.counted.work[4 * i], *theirs = &apart.counted.work[4 * i];
      processed += *ours == Processed;
      // Once a layer hides all of the light, the others need no look at their occluders.
      if (visibility == 0.0F) {
        EXPECT_TRUE(ours[0] == theirs[0] || (ours[0] == Umbra && theirs[0] == Processed))
            << what << ' ' << i << ' ' << ours[0] << ' ' << theirs[0];
        continue;
      }
      // Class, occluders, fetches and the coarsest level; area, occluders examined and used: sums over
      // layers.
      for (size_t channel = 0; channel < 4; ++channel)
        ASSERT_EQ(ours[channel], theirs[channel]) << what << ' ' << i << ' ' << channel;
      for (size_t channel = 0; channel < 3; ++channel)
        ASSERT_EQ(together.counted.search[4 * i + channel], apart.counted.search[4 * i + channel])
            << what << ' ' << i << ' ' << channel;
    }
    EXPECT_EQ(differing, 0U) << what;
    EXPECT_GT(processed, 50U) << what;
    EXPECT_GT(partly, 50U) << what;
  }
};

TEST_F(LayersTogether, AllOccludersHaveTheBitsOfAPassForEachLayer) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const char* division : {"levels", "cells"})
    expectSameBits(scene, {{"occluders.division", text(division)}}, division);
  for (const char* depths : {"nearest"}) expectSameBits(scene, {{"occluders.depths", text(depths)}}, depths);
  expectSameBits(scene, {{"occluders.gap_fill", text("diagonal")}}, "diagonal");
  for (const char* occluders : {"microquads", "microquads_microtris", "microrects"})
    expectSameBits(scene, {{"occluders", text(occluders)}}, occluders);
}

TEST_F(LayersTogether, AllStructuresHaveTheBitsOfAPassForEachLayer) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const char* structure : {"none", "n_buffer", "ysm"})
    expectSameBits(scene, {{"structure", text(structure)}}, structure);
}

TEST_F(LayersTogether, AnyNumberAndExtentOfLayersHasTheBitsOfAPassForEach) {
  const scene::Scene scene = makeScene("two_boxes", {{"light_size", 3.0}});
  for (const int64_t layers : {2, 4, 8})
    expectSameBits(scene, {{"maps.layers", layers}}, std::to_string(layers) + " layers");
  expectSameBits(scene, {{"maps.layers", int64_t{3}}, {"maps.later_extent", 0.6}}, "narrower layers");
  // A texel, and with it the offset of a receiver, is smaller in narrower layers.
  expectSameBits(scene, {{"maps.later_extent", 0.6}, {"bias", text("normal_offset")}}, "moved receivers");
}

TEST_F(LayersTogether, BiasesPatternsAndPassesHaveTheBitsOfAPassForEachLayer) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const char* bias : {"receiver_slope", "constant", "per_level"})
    expectSameBits(scene, {{"bias", text(bias)}}, bias);
  for (const char* pattern : {"regular_8", "halton_256", "random_1024"})
    expectSameBits(scene, {{"pattern", text(pattern)}}, pattern);
  for (const int64_t lanes : {1, 16})
    expectSameBits(scene, {{"passes", text("split")}, {"passes.lanes", lanes}},
                   std::to_string(lanes) + " lanes");
  expectSameBits(scene, {{"passes", text("split")}, {"passes.order", text("loop_length")}}, "ordered");
  expectSameBits(scene, {{"passes", text("single")}}, "single pass");
  for (const int64_t budget : {0, 37})
    expectSameBits(scene, {{"budget.limit", budget}}, "budget " + std::to_string(budget));
  expectSameBits(scene, {{"budget", text("masking")}}, "masking");
  expectSameBits(scene, {{"levels", text("coarsest_over")}, {"levels.source", text("filtered_depth")}},
                 "filtered depths");
}

TEST_F(LayersTogether, LightsThatAPlaneOrAShapeCutsHaveTheBitsOfAPassForEachLayer) {
  expectSameBits(makeScene("sphere_grid", {{"light_shape", text("disc")}}), {}, "disc");
  expectSameBits(makeScene("resting_sphere", {{"tilt", 70.0}, {"light_size", 12.0}}), {}, "tilted plane");
}

}  // namespace
}  // namespace limen::techniques
