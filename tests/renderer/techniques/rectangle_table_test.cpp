// SPDX-License-Identifier: BSD-3-Clause
// Masks of rectangles over samples that lie anywhere, by table, against a test of every sample on its own.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <set>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/bitmask/rectangle_table.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "tests/renderer/techniques/readback_bindings.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr int kCount = 4000;

class RectangleTable : public TechniqueTest, public testing::WithParamInterface<const char*> {
 protected:
  static std::vector<uint32_t> masks(const std::vector<glm::vec4>& given,
                                     const std::vector<glm::dvec2>& samples, int size) {
    const gl::Texture table = makeRectangleTable(samples, size);
    table.bindTexture(kRectangleMasksUnit);
    const auto count = static_cast<int>(given.size());
    const gl::Buffer in(given), out(int64_t{count} * static_cast<int64_t>(samples.size()) / 8, nullptr);
    gl::ShaderDefines defines = {{"SAMPLES", std::to_string(samples.size())},
                                 {"RECTANGLES", std::to_string(size)}};
    defineEnum(defines, "SAMPLE_PLACES", SamplePlaces::Anywhere);
    const gl::Program& program =
        context().programs().compute("tests/renderer/techniques/occlusion_mask_readback.comp.glsl", defines);
    in.bindStorage(kMaskReadbackRectanglesBuffer);
    out.bindStorage(kMaskReadbackMasksBuffer);
    program.set("count", count);
    program.dispatch({count, 1}, {64, 1});
    return out.read<uint32_t>();
  }

  static bool isSet(const std::vector<uint32_t>& masks, size_t rectangle, size_t bit, size_t samples) {
    return (masks[rectangle * samples / 32 + bit / 32] >> (bit % 32)) & 1U;
  }

  static std::vector<glm::vec4> rectangles(int steps) {
    std::mt19937 random(42);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    std::uniform_int_distribution<int> step(0, steps);
    std::vector<glm::vec4> out = {{0.0F, 0.0F, 1.0F, 1.0F}};
    while (out.size() < kCount) {
      // Bounds on the table's steps and anywhere, by turns.
      const bool onSteps = out.size() % 2 == 1;
      const auto bound = [&] { return onSteps ? float(step(random)) / float(steps) : unit(random); };
      const float x0 = bound(), x1 = bound(), y0 = bound(), y1 = bound();
      out.emplace_back(std::min(x0, x1), std::min(y0, y1), std::max(x0, x1), std::max(y0, y1));
    }
    return out;
  }
};

TEST_P(RectangleTable, ErrsOnlyWithinHalfAStepOfABound) {
  const std::vector<glm::dvec2> samples = lightSamples(fromText<LightPattern>(GetParam()));
  double last = 1.0;
  for (const int size : {16, 64, 256}) {
    const std::vector<glm::vec4> given = rectangles(size);
    const std::vector<uint32_t> found = masks(given, samples, size);
    std::vector<double> wrongShares;
    for (size_t r = 0; r < given.size(); ++r) {
      const glm::dvec4 rectangle(given[r]);
      int wrong = 0;
      for (size_t b = 0; b < samples.size(); ++b) {
        const glm::dvec2 s = samples[b];
        const bool covered =
            rectangle.x < s.x && s.x <= rectangle.z && rectangle.y < s.y && s.y <= rectangle.w;
        if (isSet(found, r, b, samples.size()) == covered) continue;
        ++wrong;
        const double off = std::min(std::min(std::abs(s.x - rectangle.x), std::abs(s.x - rectangle.z)),
                                    std::min(std::abs(s.y - rectangle.y), std::abs(s.y - rectangle.w)));
        // Bounds on steps are exact; from others the table's are half a step off at most.
        ASSERT_LE(off, r % 2 == 1 ? 0.0 : 0.5 / size + 1e-7) << "rectangle " << r << ", sample " << b;
      }
      ASSERT_TRUE(r > 0 || wrong == 0) << "the whole light";
      if (r % 2 == 0) wrongShares.push_back(wrong / double(samples.size()));
    }
    std::sort(wrongShares.begin(), wrongShares.end());
    double mean = 0.0;
    for (const double share : wrongShares) mean += share / static_cast<double>(wrongShares.size());
    std::printf("%s, table of %d: share of samples wrong: mean %f, p99 %f\n", GetParam(), size, mean,
                wrongShares[wrongShares.size() * 99 / 100]);
    EXPECT_LT(mean, last);
    last = mean;
  }
}

TEST_P(RectangleTable, RectanglesThatShareAnEdgeShareNoSample) {
  const std::vector<glm::dvec2> samples = lightSamples(fromText<LightPattern>(GetParam()));
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<float> cuts = {0.0F, 1.0F};
  for (int i = 0; i < 60; ++i) cuts.push_back(unit(random));
  std::sort(cuts.begin(), cuts.end());
  std::vector<glm::vec4> given;
  for (size_t i = 0; i + 1 < cuts.size(); ++i) given.emplace_back(cuts[i], 0.0F, cuts[i + 1], 1.0F);
  const std::vector<uint32_t> found = masks(given, samples, 64);
  for (size_t b = 0; b < samples.size(); ++b) {
    int times = 0;
    for (size_t r = 0; r < given.size(); ++r) times += isSet(found, r, b, samples.size());
    ASSERT_EQ(times, 1) << "sample " << b;
  }
}

TEST_P(RectangleTable, SamplesAreSpreadOverTheLight) {
  const std::vector<glm::dvec2> samples = lightSamples(fromText<LightPattern>(GetParam()));
  const auto expected =
      static_cast<size_t>(std::stoi(std::string(GetParam()).substr(std::string(GetParam()).rfind('_') + 1)));
  ASSERT_EQ(samples.size(), expected);
  glm::dvec2 mean(0.0);
  for (const glm::dvec2 s : samples) {
    ASSERT_TRUE(s.x >= 0.0 && s.x < 1.0 && s.y >= 0.0 && s.y < 1.0);
    mean += s / static_cast<double>(samples.size());
  }
  // The mean of n independent places has a standard deviation of 1 / sqrt(12 n); five of them.
  const double bound = 5.0 / std::sqrt(12.0 * static_cast<double>(samples.size()));
  EXPECT_NEAR(mean.x, 0.5, bound);
  EXPECT_NEAR(mean.y, 0.5, bound);
  if (std::string(GetParam()) == "stratified_256") {
    std::set<std::pair<int, int>> strata;
    for (const glm::dvec2 s : samples) strata.emplace(int(16.0 * s.x), int(16.0 * s.y));
    EXPECT_EQ(strata.size(), 256U);
  }
}

INSTANTIATE_TEST_SUITE_P(Patterns, RectangleTable,
                         testing::Values("random_128", "random_256", "random_1024", "stratified_256",
                                         "halton_256"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace limen::techniques
