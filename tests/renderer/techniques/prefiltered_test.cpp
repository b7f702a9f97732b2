// SPDX-License-Identifier: BSD-3-Clause
// Prefiltered shadow maps against what their formulas must give, in double precision, and against exact
// visibility.
#include <cmath>
#include <random>

#include "experiments/base/error.h"
#include "renderer/frame/prefiltered_map.h"
#include "renderer/gl/buffer.h"
#include "tests/renderer/techniques/readback_bindings.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Truncated Fourier series of the step, at t = z - p.
double stepSeries(double t, int terms) {
  double sum = 0.5;
  for (int k = 1; k <= terms; ++k) sum += 2.0 * std::sin((2 * k - 1) * kPi * t) / ((2 * k - 1) * kPi);
  return sum;
}

/// Chebyshev's bound for a share s at z1 and the rest at z2.
double chebyshevBound(double z1, double z2, double s, double p, double minVariance) {
  const double mean = s * z1 + (1.0 - s) * z2, variance = s * (1.0 - s) * (z2 - z1) * (z2 - z1);
  const double v = std::max(variance, minVariance);
  return p <= mean ? 1.0 : v / (v + (p - mean) * (p - mean));
}

class Prefiltered : public TechniqueTest {};

TEST_F(Prefiltered, FormulasHoldForAnyWindowOfTwoDepths) {
  constexpr int kTerms = 8;
  constexpr double kMinVariance = 1e-6;
  std::mt19937 random(20090101);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<glm::vec4> windows;
  std::vector<glm::vec2> moments;
  for (int i = 0; i < 4096; ++i) {
    const double z1 = 0.7 * unit(random), z2 = z1 + 0.1 + 0.15 * unit(random), s = unit(random);
    // At the farther depth, anywhere between the two, or beyond both.
    const double p = i % 3 == 0 ? z2 : i % 3 == 1 ? z1 + (z2 - z1) * unit(random) : z2 + 0.1 * unit(random);
    windows.emplace_back(z1, z2, s, p);
    const glm::dvec4 w(windows.back());
    moments.emplace_back(w.z * w.x + (1.0 - w.z) * w.y, w.z * w.x * w.x + (1.0 - w.z) * w.y * w.y);
  }
  const gl::Program& program =
      context().programs().compute("tests/renderer/techniques/prefiltered_readback.comp.glsl");
  const gl::Buffer in(windows), averages(moments),
      out(static_cast<int64_t>(windows.size() * sizeof(glm::vec2)), nullptr);
  in.bindStorage(kPrefilteredReadbackWindowsBuffer);
  averages.bindStorage(kPrefilteredReadbackMomentsBuffer);
  out.bindStorage(kPrefilteredReadbackResultsBuffer);
  program.set("count", static_cast<int>(windows.size()));
  program.set("terms", kTerms);
  program.set("minVariance", static_cast<float>(kMinVariance));
  program.dispatch({static_cast<int>(windows.size()), 1}, {64, 1});
  const std::vector<glm::vec2> results = out.read<glm::vec2>();
  for (size_t i = 0; i < windows.size(); ++i) {
    const glm::dvec4 w(windows[i]);
    const double exact = (w.x >= w.w ? w.z : 0.0) + (w.y >= w.w ? 1.0 - w.z : 0.0);
    // Moments up to 1 are rounded to 2^-25, and the variance v, a difference of two, to 6 such units, their
    // products included. Chebyshev's bound has slopes of at most 1 / 4v by the variance and 0.65 / sqrt(v) by
    // the mean, wherever the receiver is.
    const double v = std::max(w.z * (1.0 - w.z) * (w.y - w.x) * (w.y - w.x), kMinVariance);
    const double tolerance = 0x1p-25 * (6.0 / (4.0 * v) + 2.0 * 0.65 / std::sqrt(v)) + 1e-6;
    ASSERT_NEAR(results[i].x, chebyshevBound(w.x, w.y, w.z, w.w, kMinVariance), tolerance) << i;
    // A bound from above, whatever the receiver's depth, and the truth where it stands at the farther one.
    ASSERT_GE(results[i].x, exact - tolerance) << i;
    if (i % 3 == 0) {
      ASSERT_NEAR(results[i].x, exact, tolerance + kMinVariance / 0.01) << i;
    }
    // Beyond both all is blocked, and light bleeds through nonetheless.
    if (i % 3 == 2 && w.z > 0.1 && w.z < 0.9) {
      ASSERT_GT(results[i].x, 0.01) << i;
    }
    // Eight terms with weights that add up to 1.3, of products of two sines and cosines each, wrong by 2^-20
    // at most.
    const double series = w.z * stepSeries(w.x - w.w, kTerms) + (1.0 - w.z) * stepSeries(w.y - w.w, kTerms);
    ASSERT_NEAR(results[i].y, series, 1.3 * 4.0 * 0x1p-20) << i;
    // Ringing: from its first peak at t = 1 / 2M on the series stays within a tenth of the step (9 % for many
    // terms).
    const auto clear = [&](double t) {
      return std::abs(t) >= 0.5 / kTerms && std::abs(t) <= 1.0 - 0.5 / kTerms;
    };
    if (clear(w.x - w.w) && clear(w.y - w.w)) {
      ASSERT_NEAR(results[i].y, exact, 0.1) << i;
    }
  }
}

// One rectangle over a ground, both parallel to the map: every window holds two depths, the share of the
// nearer is what the light loses, and all of the edges fall on edges of texels. The average of the blockers
// is the rectangle's depth, so that the window is the light's cone, cut.
class OnePlane : public Prefiltered {
 protected:
  static constexpr int kResolution = 128;
  static constexpr double kBias = 1e-5;
  static constexpr int64_t kTaps = 32;

  void SetUp() override {
    Prefiltered::SetUp();
    scene_ = makeScene("parallel_rectangle");
    exact_ = render(scene_, "soft_shadows/exact_union", {}, {64, 48});
    frustum_ = frame::LightCasters(scene_).fit({}, kResolution);
    const double range = kGroundZ - frustum_.near;
    cardDepth_ = (kCardZ - frustum_.near) / range;
    receiver_ = (kGroundZ * (1.0 - kBias) - frustum_.near) / range;
    windowSize_ = scene_.lights[0].size * (1.0 / kCardZ - 1.0 / kGroundZ);
    const glm::dvec2 window = windowSize_ / (frustum_.high - frustum_.low) * double(kResolution);
    // Rounding of an average over a window (see summed_area_table_test.cpp), of values up to 1 all over the
    // map.
    averageError_ = (4.0 * frame::SummedAreaTable::additions(kResolution) + 128.0) * 0x1p-24 * kResolution *
                    kResolution / (window.x * window.y);
  }

  /// Share of a receiver's window that lies on the map.
  double onMap(const float* receiver) const {
    double share = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      const double centre = double(receiver[axis]) / receiver[2], half = 0.5 * windowSize_[axis];
      share *= std::max(0.0, std::min(centre + half, frustum_.high[axis]) -
                                 std::max(centre - half, frustum_.low[axis])) /
               (2.0 * half);
    }
    return share;
  }

  /// `formula`: visibility that a window must give of which a share is blocked. `bound`: distance, at most,
  /// of that from the truth. `tolerance`: of rounding.
  void expectFormula(const std::string& technique, Given given, double tolerance, double bound,
                     const std::function<double(double)>& formula) {
    given["resolution"] = int64_t{kResolution};
    given["bias.constant"] = kBias;
    given["window.taps"] = kTaps;
    const Rendered rendered = render(scene_, technique, given, {64, 48});
    int penumbra = 0, umbra = 0;
    for (size_t i = 0; i < rendered.product.pixels(); ++i) {
      if (rendered.receivers.data[4 * i + 3] < 0.0F || rendered.receivers.data[4 * i + 2] < 1.99F) continue;
      const double exact = exact_.product.data[i], value = rendered.product.data[i];
      // Blockers between the outermost taps and the window's edge are not found; on two axes, some more.
      if (value == 1.0 && exact > 1.0 - 1.0 / kTaps) continue;
      if (exact == 1.0) {
        ASSERT_EQ(value, 1.0);
        continue;
      }
      // What lies beyond the map is lit; all that blocks is on it.
      const double share = onMap(&rendered.receivers.data[4 * i]);
      const double expected = 1.0 - share * (1.0 - formula((1.0 - exact) / share));
      ASSERT_NEAR(value, expected, tolerance) << technique << ", exactly " << exact;
      ASSERT_NEAR(value, exact, bound + tolerance) << technique;
      penumbra += exact > 0.0 ? 1 : 0;
      umbra += exact == 0.0 ? 1 : 0;
    }
    EXPECT_GT(penumbra, 200);
    EXPECT_GT(umbra, 20);
  }

  static constexpr double kCardZ = 2.0 - 0.7, kGroundZ = 2.0;
  scene::Scene scene_;
  Rendered exact_;
  frame::LightFrustum frustum_;
  glm::dvec2 windowSize_{0.0};  // in tangents
  double cardDepth_ = 0.0, receiver_ = 0.0, averageError_ = 0.0;
};

TEST_F(OnePlane, VarianceIsChebyshevsBound) {
  const double gap = receiver_ - cardDepth_;
  for (const char* sums : {"float", "float_mean", "fixed"}) {
    // Slopes as above: 1 / gap^2 by the variance, which errs by three times an average, and 2 / gap by the
    // mean. An exact reference in floats and the window's own place: 1e-4. Values of 18 bits are off by
    // 2^-19.
    const double average = std::string(sums) == "fixed" ? 0x1p-19 + 1e-6 : averageError_;
    const double tolerance = average * (3.0 / (gap * gap) + 2.0 / gap) + 1e-4;
    // The receiver is not at the farther depth but the bias before it, b: (1 - s) (1 + 2 b / gap), at most;
    // and the least variance is a gap's share in umbra.
    const double bias = 1.0 - receiver_, bound = 2.0 * bias / gap + 1e-6 / (gap * gap);
    expectFormula("soft_shadows/variance", {{"prefilter.form", std::string(sums)}}, tolerance, bound,
                  [&](double s) { return chebyshevBound(cardDepth_, 1.0, s, receiver_, 1e-6); });
  }
}

TEST_F(OnePlane, ExponentialsAreTheirSum) {
  for (const double c : {20.0, 80.0}) {
    const auto formula = [&](double s) {
      return std::min(
          1.0, s * std::exp(c * (cardDepth_ - receiver_)) + (1.0 - s) * std::exp(c * (1.0 - receiver_)));
    };
    // The ground's exponential, the largest on the map, is taken for 1; depths are floats: c 2^-23 more.
    const double bound = std::exp(c * (cardDepth_ - receiver_)) + std::expm1(c * (1.0 - receiver_));
    expectFormula("soft_shadows/exponential", {{"prefilter", std::string("sums")}, {"exponent", c}},
                  averageError_ + 4.0 * c * 0x1p-23 + 1e-4, bound, formula);
  }
}

TEST_F(OnePlane, ConvolutionIsItsSeries) {
  for (const int64_t terms : {4, 16}) {
    constexpr double kShare = 0.875;
    const auto series = [&](double z) {
      return stepSeries(kShare * (z - receiver_) + 0.5 / double(terms), static_cast<int>(terms));
    };
    const auto formula = [&](double s) {
      return std::clamp(s * series(cardDepth_) + (1.0 - s) * series(1.0), 0.0, 1.0);
    };
    // Averages of sines up to 1, which enter with weights 2 / c_k that add up to no more than 1.6, twice;
    // depths are floats, and the series' slope is 2 M.
    const double tolerance = 2.0 * 1.6 * averageError_ + 2.0 * double(terms) * 0x1p-22 + 1e-4;
    const double bound = std::max(std::abs(series(cardDepth_)), std::abs(series(1.0) - 1.0));
    EXPECT_LT(bound, 0.1) << "ringing";
    expectFormula("soft_shadows/convolution", {{"terms", terms}}, tolerance, bound, formula);
  }
}

TEST_F(Prefiltered, SumsOfMoreThan32BitsAreRefused) {
  const auto sums = [](int64_t bits) {
    return refusal("soft_shadows/variance",
                   {{"prefilter.form", std::string("fixed")}, {"prefilter.form.bits", bits}});
  };
  // 2^(12 + 20) counts do not fit, 2^(13 - 1 + 20) do.
  EXPECT_FALSE(sums(12));
  const std::optional<Error> error = sums(13);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where(), "prefilter.form.bits");
  EXPECT_FALSE(error->hint().empty());
}

TEST_F(Prefiltered, ValuesOfWhatIsNotThereCannotBeWritten) {
  const auto accepted = [](const std::string& technique, const Given& given) {
    return !refusal(technique, given).has_value();
  };
  const auto text = [](const char* value) { return std::string(value); };
  EXPECT_TRUE(accepted("soft_shadows/variance", {{"window", text("fixed")}, {"window.radius", 8.0}}));
  EXPECT_FALSE(accepted("soft_shadows/variance", {{"window.radius", 8.0}}));
  EXPECT_FALSE(accepted("soft_shadows/variance", {{"prefilter.form.bits", int64_t{8}}}));
  EXPECT_FALSE(accepted("soft_shadows/variance", {{"window", text("fixed")}, {"window.taps", int64_t{4}}}));
  EXPECT_FALSE(accepted("soft_shadows/variance", {{"window", text("fixed")}, {"window.scale", 2.0}}));
  EXPECT_FALSE(accepted("soft_shadows/variance", {{"window", text("convolved")}}));
  EXPECT_FALSE(accepted("soft_shadows/exponential", {{"prefilter.form", text("fixed")}}));
  EXPECT_FALSE(accepted("soft_shadows/convolution", {{"window.threshold", 0.2}}));
  EXPECT_FALSE(accepted("soft_shadows/occlusion_textures", {{"raster", text("hardware")}}));
}

}  // namespace
}  // namespace limen::techniques
