// SPDX-License-Identifier: BSD-3-Clause
// The metrics that decide how many samples a pixel gets, against the thesis's formulas in double precision,
// and where the printed formulas lose their digits.
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/antialiasing/window_order.h"
#include "tests/renderer/antialiasing/metric_bindings.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::techniques {
namespace {

constexpr int kSamples = 16;
constexpr double kEps = 0x1p-24;
using Window = std::array<glm::vec4, kSamples>;  // normal, depth

struct Metrics {
  double range, cone, depthVariance, normalVariance;
};

/// Holländer 2013, section 4.3.1, in double precision; the same numbers with normals of exact length.
Metrics twin(const Window& window) {
  double low = 1e300, high = -1e300, sum = 0.0;
  glm::dvec3 mean(0.0);
  for (const glm::vec4& sample : window) {
    low = std::min(low, double(sample.w));
    high = std::max(high, double(sample.w));
    sum += sample.w;
    mean += glm::normalize(glm::dvec3(sample));
  }
  mean = glm::normalize(mean);
  double variance = 0.0, least = 1.0, deviation = 0.0;
  for (const glm::vec4& sample : window) {
    const double cosine = glm::dot(mean, glm::normalize(glm::dvec3(sample)));
    variance += (sample.w - sum / kSamples) * (sample.w - sum / kSamples) / kSamples;
    least = std::min(least, std::abs(cosine));
    deviation += (1.0 - cosine) * (1.0 - cosine);
  }
  return {high - low, std::sqrt(std::max(0.0, 1.0 - least)), variance, deviation};
}

class WindowMetrics : public gl::GlTest {
 protected:
  static Metrics onGpu(const Window& window, bool printed) {
    const gl::ShaderDefines defines = {
        {"METRIC_FORM_STABLE", "0"}, {"METRIC_FORM_PRINTED", "1"}, {"METRIC_FORM", printed ? "1" : "0"}};
    const gl::Program& program =
        context().programs().compute("tests/renderer/antialiasing/metric_readback.comp.glsl", defines);
    const gl::Buffer in(std::vector<glm::vec4>(window.begin(), window.end())), out(16, nullptr);
    in.bindStorage(kMetricWindowsBuffer);
    out.bindStorage(kMetricResultsBuffer);
    program.dispatch({1, 1}, {1, 1});
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::vector<float> r = out.read<float>();
    return {r[0], r[1], r[2], r[3]};
  }
  /// Depths around `depth`, normals around `axis`, each within the given spread.
  static Window anyWindow(std::mt19937& random, float depth, float depthSpread, glm::vec3 axis,
                          float normalSpread) {
    std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
    Window window;
    for (glm::vec4& sample : window) {
      const glm::vec3 off(unit(random), unit(random), unit(random));
      sample = glm::vec4(glm::normalize(axis + normalSpread * off), depth + depthSpread * unit(random));
    }
    return window;
  }
};

// Differences from the first depth D <= spread are exact to kEps D each. Sums of 16 add no more than 16 kEps
// D to the mean, and squares, their sum and the quotient no more than 20 kEps D^2 to the variance: below 64
// kEps D^2 together. A float normal is off its direction by 2 kEps at most, a normalised sum of 16 by 20
// kEps, so that an angle is known to 32 kEps and the cone, angle / sqrt(2), to as much; the sum of 16 squares
// of angle^2 / 2 follows by its slope.
TEST_F(WindowMetrics, StableFormsEqualTheFormulasInDoublePrecision) {
  std::mt19937 random(7);
  for (const float depth : {1.0F, 1e4F, 1e6F})
    for (const float spread : {1e-3F, 0.5F})
      for (int i = 0; i < 20; ++i) {
        const float depthSpread = spread * depth;
        const Window window = anyWindow(random, depth, depthSpread, {0.3F, -0.5F, 0.8F}, spread);
        const Metrics expected = twin(window), found = onGpu(window, false);
        EXPECT_NEAR(found.range, expected.range, 2.0 * kEps * depth);
        EXPECT_NEAR(found.depthVariance, expected.depthVariance,
                    64.0 * kEps * 4.0 * depthSpread * depthSpread);
        EXPECT_NEAR(found.cone, expected.cone, 32.0 * kEps);
        const double largest = 2.0 * expected.cone * expected.cone;  // square of the largest angle, at least
        EXPECT_NEAR(found.normalVariance, expected.normalVariance,
                    16.0 * 4.0 * std::pow(largest, 1.5) * 32.0 * kEps +
                        1e-3 * expected.normalVariance * spread + 1e-13);
      }
}

// At 2^20 m floats lie 1/16 m apart. Eight depths there and eight 1/16 m farther have the variance 1/1024
// m^2; their squares are near 2^40, where floats lie 2^17 m^2 apart, more than a hundred million times as
// far.
TEST_F(WindowMetrics, FarDepthsKeepTheirVarianceInTheStableFormAlone) {
  Window window;
  for (int i = 0; i < kSamples; ++i)
    window[size_t(i)] = {0.0F, 0.0F, 1.0F, 1048576.0F + (i % 2 == 0 ? 0.0F : 0.125F)};
  EXPECT_DOUBLE_EQ(twin(window).depthVariance, 1.0 / 256.0);
  EXPECT_NEAR(onGpu(window, false).depthVariance, 1.0 / 256.0, 64.0 * kEps / 64.0);
  EXPECT_GT(std::abs(onGpu(window, true).depthVariance - 1.0 / 256.0), 0.5 / 256.0);
}

// Two halves 2e-4 rad apart lie 1e-4 rad from their mean: NC = sqrt(1 - cos 1e-4) = 7.07e-5. The cosine is
// within 5e-9 of 1, where floats lie 6e-8 apart, so that the printed form can only be 0 or at least 2.4e-4.
TEST_F(WindowMetrics, SmallAnglesKeepTheirConeInTheStableFormAlone) {
  Window window;
  for (int i = 0; i < kSamples; ++i) {
    const double angle = i % 2 == 0 ? 1e-4 : -1e-4;
    window[size_t(i)] = glm::vec4(glm::vec3(std::sin(angle), 0.0, std::cos(angle)), 1.0F);
  }
  EXPECT_NEAR(onGpu(window, false).cone, std::sqrt(1.0 - std::cos(1e-4)), 32.0 * kEps);
  EXPECT_GT(std::abs(onGpu(window, true).cone - 7.07e-5), 6e-5);
}

// Half of the normals face up and half down: the sum vanishes, and to normalise it is to divide by 0.
// Whichever side they face, the planes are parallel: the cone is closed. About the first normal, eight
// deviate by 1 - cos(180 degrees) = 2.
TEST_F(WindowMetrics, OpposingNormalsAreFiniteInTheStableForm) {
  Window window;
  for (int i = 0; i < kSamples; ++i) window[size_t(i)] = {0.0F, 0.0F, i % 2 == 0 ? 1.0F : -1.0F, 1.0F};
  const Metrics found = onGpu(window, false);
  EXPECT_EQ(found.cone, 0.0);
  EXPECT_EQ(found.normalVariance, 8.0 * 4.0);
}

// Typed from Holländer 2013, Fig. 4.7.
TEST(WindowOrder, IsThatOfTheThesisAndTakesEverySampleOnce) {
  const std::vector<std::vector<int>> printed = {
      {0, 2, 3, 1}, {2, 6, 3, 5, 0, 8, 1, 7, 4}, {1, 8, 2, 10, 12, 4, 14, 6, 3, 11, 0, 9, 15, 7, 13, 5}};
  for (int window = 2; window <= 4; ++window) {
    const std::vector<int> ranks = printed[size_t(window - 2)];
    const std::vector<glm::ivec2> order = windowOrder(window);
    ASSERT_EQ(order.size(), size_t(window * window));
    std::vector<int> taken(order.size());
    for (size_t n = 0; n < order.size(); ++n) {
      const size_t at = size_t(order[n].y * window + order[n].x);
      EXPECT_EQ(ranks[at], int(n));
      ++taken[at];
    }
    for (const int times : taken) EXPECT_EQ(times, 1);
  }
}

}  // namespace
}  // namespace limen::techniques
