// SPDX-License-Identifier: BSD-3-Clause
// Masks of occluder rectangles against a test of every sample on its own.
#include <algorithm>
#include <cmath>
#include <random>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "tests/renderer/techniques/readback_bindings.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr int kRectangles = 20000;

struct Pattern {
  LightPattern pattern;
  int side;
  bool jittered;
};

/// Sample positions as the specification defines them; exact in float since all denominators are powers of
/// two.
glm::vec2 samplePosition(const Pattern& pattern, int i, int j) {
  const float n = static_cast<float>(pattern.side);
  if (!pattern.jittered) return {(static_cast<float>(i) + 0.5F) / n, (static_cast<float>(j) + 0.5F) / n};
  return {(static_cast<float>(i) + (j % 2 == 0 ? 0.25F : 0.75F)) / n,
          (static_cast<float>(j) + (i % 2 == 0 ? 0.75F : 0.25F)) / n};
}

/// Random rectangles, among them many with bounds exactly on samples, one step of float beside them, on cell
/// borders, at 0 and 1, and empty ones.
std::vector<glm::vec4> rectangles(const Pattern& pattern) {
  std::mt19937 random(20260101);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::uniform_int_distribution<int> kind(0, 7), cell(0, 4 * pattern.side);
  const auto bound = [&] {
    const float onGrid = static_cast<float>(cell(random)) / static_cast<float>(4 * pattern.side);
    switch (kind(random)) {
      case 0:
        return 0.0F;
      case 1:
        return 1.0F;
      case 2:
        return onGrid;
      case 3:
        return std::nextafter(onGrid, 0.0F);
      case 4:
        return std::min(std::nextafter(onGrid, 2.0F), 1.0F);
      case 5:
        return unit(random) * 1e-30F;
      default:
        return unit(random);
    }
  };
  std::vector<glm::vec4> out;
  for (int i = 0; i < kRectangles; ++i) {
    float x0 = bound(), x1 = bound(), y0 = bound(), y1 = bound();
    if (x0 > x1) std::swap(x0, x1);
    if (y0 > y1) std::swap(y0, y1);
    out.emplace_back(x0, y0, x1, y1);
  }
  out[0] = {0.0F, 0.0F, 1.0F, 1.0F};  // the whole light: every bit, up to the 32nd column
  return out;
}

class OcclusionMask : public TechniqueTest, public testing::WithParamInterface<Pattern> {
 protected:
  static const gl::Program& maskReadback(const Pattern& pattern) {
    gl::ShaderDefines defines;
    defineSamples(defines, pattern.pattern);
    return context().programs().compute("tests/renderer/techniques/occlusion_mask_readback.comp.glsl",
                                        defines);
  }
};

TEST_P(OcclusionMask, EqualsTestingEverySample) {
  const Pattern pattern = GetParam();
  const int samples = pattern.side * pattern.side, words = samples / 32;
  const std::vector<glm::vec4> given = rectangles(pattern);
  const gl::Buffer in(given), out(int64_t{kRectangles} * words * 4, nullptr);
  const gl::Program& program = maskReadback(pattern);
  in.bindStorage(kMaskReadbackRectanglesBuffer);
  out.bindStorage(kMaskReadbackMasksBuffer);
  program.set("count", kRectangles);
  program.dispatch({kRectangles, 1}, {64, 1});
  const auto masks = out.read<uint32_t>();
  int wrong = 0;
  for (int r = 0; r < kRectangles; ++r)
    for (int j = 0; j < pattern.side; ++j)
      for (int i = 0; i < pattern.side; ++i) {
        const glm::vec4 rectangle = given[static_cast<size_t>(r)];
        const glm::vec2 s = samplePosition(pattern, i, j);
        const bool covered =
            rectangle.x < s.x && s.x <= rectangle.z && rectangle.y < s.y && s.y <= rectangle.w;
        const int bit = j * pattern.side + i;
        const bool set = (masks[static_cast<size_t>(r * words + bit / 32)] >> (bit % 32)) & 1U;
        if (covered != set && ++wrong < 5)
          ADD_FAILURE() << "rectangle " << rectangle.x << " " << rectangle.y << " " << rectangle.z << " "
                        << rectangle.w << ", sample (" << i << ", " << j << "): covered " << covered
                        << ", bit " << set;
      }
  EXPECT_EQ(wrong, 0);
}

TEST_P(OcclusionMask, RectanglesThatShareAnEdgeShareNoSample) {
  // Strips between neighbouring random cuts tile the light: their masks are disjoint and together full.
  const Pattern pattern = GetParam();
  const int samples = pattern.side * pattern.side, words = samples / 32;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<float> cuts = {0.0F, 1.0F};
  for (int i = 0; i < 40; ++i) cuts.push_back(unit(random));
  for (int i = 0; i < pattern.side; ++i) cuts.push_back(samplePosition(pattern, i, 0).x);
  std::sort(cuts.begin(), cuts.end());
  std::vector<glm::vec4> given;
  for (size_t i = 0; i + 1 < cuts.size(); ++i) given.emplace_back(cuts[i], 0.0F, cuts[i + 1], 1.0F);
  const gl::Buffer in(given), out(static_cast<int64_t>(given.size()) * words * 4, nullptr);
  const gl::Program& program = maskReadback(pattern);
  in.bindStorage(kMaskReadbackRectanglesBuffer);
  out.bindStorage(kMaskReadbackMasksBuffer);
  program.set("count", static_cast<int>(given.size()));
  program.dispatch({static_cast<int>(given.size()), 1}, {64, 1});
  const auto masks = out.read<uint32_t>();
  std::vector<int> timesSet(static_cast<size_t>(samples));
  for (size_t i = 0; i < masks.size(); ++i)
    for (int bit = 0; bit < 32; ++bit)
      timesSet[i % static_cast<size_t>(words) * 32 + static_cast<size_t>(bit)] += (masks[i] >> bit) & 1U;
  for (int i = 0; i < samples; ++i) ASSERT_EQ(timesSet[static_cast<size_t>(i)], 1) << "sample " << i;
}

INSTANTIATE_TEST_SUITE_P(
    Patterns, OcclusionMask,
    testing::Values(Pattern{LightPattern::Regular8, 8, false}, Pattern{LightPattern::Regular16, 16, false},
                    Pattern{LightPattern::Regular32, 32, false}, Pattern{LightPattern::Jittered16, 16, true}),
    [](const auto& instance) { return std::string(limen::toText(instance.param.pattern)); });

}  // namespace
}  // namespace limen::techniques
