// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/summed_area_table.h"

#include <epoxy/gl.h>

#include <cmath>
#include <random>

#include "tests/renderer/frame/readback_bindings.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

constexpr double kRounding = 0x1p-24;

/// Values of all layers, texel by texel, channel by channel.
template <class Value>
struct Layers {
  int side, layers, channels;
  std::vector<Value> values;

  Layers(int s, int l, int c) : side(s), layers(l), channels(c), values(static_cast<size_t>(s) * s * l * c) {}
  const Value& at(int x, int y, int layer, int channel) const {
    return values[((static_cast<size_t>(layer) * side + y) * side + x) * channels + channel];
  }
};

class SummedAreaTableTest : public gl::GlTest {
 protected:
  /// What the table says of each window, a layer after another.
  template <class Value>
  static std::vector<glm::vec2> ask(const Layers<Value>& map, SumForm form,
                                    const std::vector<glm::vec4>& windows) {
    const SummedAreaTable table(context(), map.side, map.layers, map.channels, form);
    glTextureSubImage3D(table.texture().id(), 0, 0, 0, 0, map.side, map.side, map.layers,
                        form == SumForm::Fixed ? (map.channels == 1 ? GL_RED_INTEGER : GL_RG_INTEGER)
                                               : (map.channels == 1 ? GL_RED : GL_RG),
                        form == SumForm::Fixed ? GL_UNSIGNED_INT : GL_FLOAT, map.values.data());
    table.build();
    const gl::Program& program = context().programs().compute(
        "tests/renderer/frame/summed_area_readback.comp.glsl", SummedAreaTable::defines(form));
    const int count = static_cast<int>(windows.size());
    const gl::Buffer in(windows), out(int64_t{8} * count * map.layers, nullptr);
    table.bind(kSumsReadbackSumsUnit);
    in.bindStorage(kSumsReadbackWindowsBuffer);
    out.bindStorage(kSumsReadbackTotalsBuffer);
    program.set("count", count);
    program.set("layers", map.layers);
    program.set("sumsUnit", 1.0F);
    program.dispatch({count, 1}, {64, 1});
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    return out.read<glm::vec2>();
  }

  /// Integral of a channel over a window, in double precision, texel by texel.
  template <class Value>
  static double integral(const Layers<Value>& map, glm::vec4 window, int layer, int channel) {
    const auto overlap = [](double low, double high, int texel) {
      return std::max(0.0, std::min(high, texel + 1.0) - std::max(low, double(texel)));
    };
    double total = 0.0;
    for (int y = 0; y < map.side; ++y)
      for (int x = 0; x < map.side; ++x)
        total += overlap(window.x, window.z, x) * overlap(window.y, window.w, y) *
                 static_cast<double>(map.at(x, y, layer, channel));
    return total;
  }

  /// Windows on and between texels, of every size, down to within one texel, and up to the whole map.
  static std::vector<glm::vec4> someWindows(int side, std::mt19937& random) {
    std::uniform_real_distribution<float> place(0.0F, static_cast<float>(side));
    std::vector<glm::vec4> out = {{0.0F, 0.0F, side, side},
                                  {0.0F, 0.0F, 0.5F, side},
                                  {0.25F, 0.25F, 0.75F, 0.5F},
                                  {float(side) - 0.5F, 0.0F, side, 0.25F}};
    for (int i = 0; i < 100; ++i) {
      glm::vec2 a(place(random), place(random)), b(place(random), place(random));
      if (i % 3 == 0) a = glm::floor(a), b = glm::floor(b);
      if (i % 4 == 0) b = glm::min(a + 0.3F, glm::vec2(side));
      out.emplace_back(glm::min(a, b), glm::max(a, b));
    }
    return out;
  }
};

TEST_F(SummedAreaTableTest, WholeNumbersAddUpExactly) {
  // Values up to 2^8 over 100 x 100 texels stay below 2^24: floats hold every sum over whole texels.
  std::mt19937 random(8);
  for (const int side : {1, 2, 31, 64, 100})
    for (const int channels : {1, 2}) {
      Layers<uint32_t> map(side, 2, channels);
      for (uint32_t& value : map.values) value = random() % 256;
      std::vector<glm::vec4> windows;
      for (const glm::vec4& window : someWindows(side, random)) windows.push_back(glm::floor(window));
      const std::vector<glm::vec2> sums = ask(map, SumForm::Fixed, windows);
      for (int layer = 0; layer < 2; ++layer)
        for (size_t i = 0; i < windows.size(); ++i)
          for (int channel = 0; channel < channels; ++channel)
            ASSERT_EQ(sums[layer * windows.size() + i][channel], integral(map, windows[i], layer, channel))
                << side << " texels, window " << i;
    }
}

TEST_F(SummedAreaTableTest, WholeNumbersMayOverflowWhereTheWindowDoesNot) {
  // Sums wrap at 2^32, and so do their differences: a window whose own sum is less is exact all the same.
  Layers<uint32_t> map(32, 1, 1);
  for (uint32_t& value : map.values) value = 0x00f00000U;  // 1024 of them: 15 times 2^30
  const std::vector<glm::vec2> sums = ask(map, SumForm::Fixed, {{8.0F, 8.0F, 16.0F, 16.0F}});
  EXPECT_EQ(sums[0].x, 64.0F * 15728640.0F);
}

// Each prefix sum errs by at most additions() * 2^-24 times the sum S of all absolute values. A window takes
// them with weights that add up to 4 in absolute value: along an axis w1, w1 - 1, 1 - w3, w3. Its own
// subtractions and nine weighted additions round values up to 4 S some 30 times: 32 more units are enough.
double errorBound(int side, double absoluteSum) {
  return (4.0 * SummedAreaTable::additions(side) + 4.0 * 32.0) * kRounding * absoluteSum;
}

TEST_F(SummedAreaTableTest, FloatsKeepToTheirBound) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> depth(-1.0F, 3.0F);
  double largest = 0.0;
  for (const int side : {1, 2, 33, 128})
    for (const int channels : {1, 2}) {
      Layers<float> map(side, 2, channels);
      for (float& value : map.values) value = depth(random);
      const std::vector<glm::vec4> windows = someWindows(side, random);
      const std::vector<glm::vec2> sums = ask(map, SumForm::Float, windows);
      for (int layer = 0; layer < 2; ++layer)
        for (int channel = 0; channel < channels; ++channel) {
          double absolute = 0.0;
          for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) absolute += std::abs(double(map.at(x, y, layer, channel)));
          for (size_t i = 0; i < windows.size(); ++i) {
            const double error = std::abs(sums[layer * windows.size() + i][channel] -
                                          integral(map, windows[i], layer, channel));
            ASSERT_LE(error, errorBound(side, absolute)) << side << " texels, window " << i;
            largest = std::max(largest, error / errorBound(side, absolute));
          }
        }
    }
  RecordProperty("largest_share_of_bound", std::to_string(largest));
}

TEST_F(SummedAreaTableTest, WithoutTheMeanFloatsLoseLess) {
  // Depths of a far surface: 0.95 to 1. The deviation from any constant among them is 0.05 at most, where the
  // values themselves are 0.95 at least: a bound on the error that is 19 times smaller, but for the rounding
  // of each value less the constant (2^-24 each) and of the mean's share (one rounding of a sum up to the
  // whole map's).
  std::mt19937 random(10);
  std::uniform_real_distribution<float> depth(0.95F, 1.0F);
  constexpr int kSide = 128;
  Layers<float> map(kSide, 1, 1);
  for (float& value : map.values) value = depth(random);
  const std::vector<glm::vec4> windows = someWindows(kSide, random);
  double total[2] = {0.0, 0.0};
  for (const SumForm form : {SumForm::Float, SumForm::FloatMean}) {
    const bool withoutMean = form == SumForm::FloatMean;
    const std::vector<glm::vec2> sums = ask(map, form, windows);
    const double texels = double(kSide) * kSide;
    const double bound =
        withoutMean ? errorBound(kSide, 0.05 * texels) + 4.0 * kRounding * texels : errorBound(kSide, texels);
    for (size_t i = 0; i < windows.size(); ++i) {
      const double error = std::abs(sums[i].x - integral(map, windows[i], 0, 0));
      ASSERT_LE(error, bound) << "window " << i;
      // Windows much smaller than the map, where it matters.
      if ((windows[i].z - windows[i].x) * (windows[i].w - windows[i].y) < 0.1 * texels)
        total[withoutMean ? 1 : 0] += error;
    }
  }
  RecordProperty("float_error", std::to_string(total[0]));
  RecordProperty("float_mean_error", std::to_string(total[1]));
  EXPECT_LT(total[1], 0.5 * total[0]);
}

}  // namespace
}  // namespace limen::frame
