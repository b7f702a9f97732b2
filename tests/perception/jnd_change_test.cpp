// SPDX-License-Identifier: BSD-3-Clause
// The metric jnd_change on frames with known errors: what may count, and in which step.
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/base/error.h"
#include "jnd_helpers.h"
#include "metric_helpers.h"
#include "perception/metrics/metric_texture.h"
#include "perception/metrics/path.h"
#include "popping_images.h"

namespace limen::perception {
namespace {

constexpr int kSteps = 4;

/// A textured surface that the camera moves over, `shiftPx` to the right by now, and errors on it.
struct Film {
  double pxPerStep = 0.0;
  std::function<double(int frame, double u, double v)> error;  ///< at a point of the surface
  bool depthChanges = false;                                   ///< another surface in every frame

  double shift(int frame) const { return pxPerStep * frame; }
  Image reference(int frame) const {
    Image out(kWidth, kHeight, 3);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int c = 0; c < 3; ++c) {
          const double u = x - shift(frame), v = y;
          out.at(x, y, c) = static_cast<float>(0.4 + 0.1 * std::sin(0.31 * u + c) + 0.1 * std::cos(0.23 * v));
        }
    return out;
  }
  Image test(int frame) const {
    Image out = reference(frame);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int c = 0; c < 3; ++c) out.at(x, y, c) += static_cast<float>(error(frame, x - shift(frame), y));
    return out;
  }
};

class JndChange : public JndTest {
 protected:
  std::vector<double> change(const Film& film) {
    const Image test = film.test(0), reference = film.reference(0);
    const PathRenderer path = [&](const PathRequest& request, const PathVisitor& visit) {
      EXPECT_EQ(request.steps, kSteps);
      struct Held {
        gl::Texture test, reference, displacement, depthBefore, depth;
      };
      std::vector<Held> held;
      std::vector<PathFrame> frames;
      for (int frame = 0; frame <= kSteps; ++frame) {
        Image displacement(kWidth, kHeight, 2),
            depth(kWidth, kHeight, 1, 1.0F + (film.depthChanges ? frame : 0));
        for (size_t pixel = 0; pixel < displacement.pixels(); ++pixel)
          displacement.data[2 * pixel] = static_cast<float>(film.pxPerStep);
        gl::Texture moved(gl::Format::RG32F, {kWidth, kHeight});
        moved.write(displacement);
        held.push_back({metricTexture(film.test(frame)), metricTexture(film.reference(frame)),
                        std::move(moved), metricTexture(depth), metricTexture(depth)});
      }
      for (const Held& one : held) {
        PathFrame frame{&one.test, &one.reference, nullptr, {}, nullptr, nullptr, nullptr};
        if (film.pxPerStep != 0.0 || film.depthChanges)
          frame.displacement = &one.displacement, frame.depthBefore = &one.depthBefore,
          frame.depth = &one.depth;
        frames.push_back(frame);
      }
      for (int step = 1; step <= kSteps; ++step)
        visit(step, frames[static_cast<size_t>(step - 1)], frames[static_cast<size_t>(step)]);
    };
    ComparisonInput input = pairOf(test, reference);
    input.gpu = &*gpu_;
    input.path = &path;
    return measure("jnd_change", input, {{"steps", int64_t{kSteps}}, {"path", "camera"}}).figures;
  }

  static void expectNothing(const std::vector<double>& figures) {
    for (const int figure : {kMedian, kP95, kLargest, kShare, kStep}) EXPECT_EQ(figures.at(figure), 0.0);
    EXPECT_EQ(figures.at(kDetection), DetectionModel{}.guessRate);
  }
};

/// A dark disc on the surface, plain to see.
double disc(double u, double v, double atU = 48.0) {
  return std::hypot(u - atU, v - 36.0) < 9.0 ? -0.2 : 0.0;
}

TEST_F(JndChange, TheReferencesOwnChangeIsNone) {
  for (const double speed : {0.0, 2.0, 2.37})
    expectNothing(change({speed, [](int, double, double) { return 0.0; }}));
}

TEST_F(JndChange, AnErrorThatStaysOnItsSurfaceIsNone) {
  const auto error = [](int, double u, double v) { return disc(u, v); };
  expectNothing(change({0.0, error}));
  expectNothing(change({3.0, error}));
  // Between pixels a hard edge is sampled elsewhere in every frame. What is left is less than 1 JND.
  const std::vector<double> between = change({2.37, error});
  EXPECT_LT(between[kLargest], 1.0);
  EXPECT_LT(between[kP95], 0.1);
  const auto smooth = [](int, double u, double v) {
    return -0.2 * std::exp(-0.005 * ((u - 48) * (u - 48) + (v - 36) * (v - 36)));
  };
  EXPECT_LT(change({2.37, smooth})[kLargest], 0.1);
}

TEST_F(JndChange, AnErrorThatAppearsIsFoundInItsFrame) {
  for (const double speed : {0.0, 3.0})
    for (int at = 1; at <= kSteps; ++at) {
      // It stays from then on, which counts for nothing.
      const std::vector<double> figures =
          change({speed, [&](int frame, double u, double v) { return frame < at ? 0.0 : disc(u, v); }});
      EXPECT_EQ(figures[kStep], at) << speed;
      EXPECT_GT(figures[kLargest], 2.0) << speed;
      EXPECT_GT(figures[kDetection], 0.1) << speed;
    }
}

TEST_F(JndChange, AnErrorThatGoesIsFoundInItsFrame) {
  const std::vector<double> figures =
      change({0.0, [](int frame, double u, double v) { return frame < 3 ? disc(u, v) : 0.0; }});
  EXPECT_EQ(figures[kStep], 3);
  EXPECT_GT(figures[kLargest], 2.0);
}

TEST_F(JndChange, AnErrorThatStaysOnTheScreenSwimsOverSurfaces) {
  const double speed = 3.0;
  const std::vector<double> figures =
      change({speed, [&](int frame, double u, double v) { return disc(u + speed * frame, v); }});
  EXPECT_GT(figures[kLargest], 1.0);
}

// The predictor on the pair that the definition names, nothing moving: reference now plus error before.
TEST_F(JndChange, IsThePredictorOnTheFrameAsItWouldHaveBeen) {
  const Film film{0.0, [](int frame, double u, double v) {
                    return frame < 2 ? 0.05 * std::sin(0.5 * u) : disc(u, v) + 0.03 * std::cos(0.4 * v);
                  }};
  const std::vector<double> figures = change(film);
  Image expected = film.reference(2);
  const Image before = film.test(1), exactBefore = film.reference(1);
  for (size_t i = 0; i < expected.data.size(); ++i) expected.data[i] += before.data[i] - exactBefore.data[i];
  const PoppingResult predicted =
      predictPopping(linearPair(film.test(2), expected), displayPreset("desktop_24"));
  EXPECT_EQ(figures[kStep], 2);
  EXPECT_NEAR(figures[kLargest], predicted.summary.largestJnd, 1e-3 * predicted.summary.largestJnd);
  EXPECT_NEAR(figures[kRating], predicted.summary.largestRating, 0.01);
}

TEST_F(JndChange, AnErrorOnASurfaceNotSeenBeforeHasNotChanged) {
  expectNothing(
      change({2.0, [](int frame, double u, double v) { return frame == 2 ? disc(u, v) : 0.0; }, true}));
}

TEST_F(JndChange, NeedsFrames) {
  const Image image = randomImage(16, 16, 3, 1);
  ComparisonInput input = pairOf(image, image);
  input.gpu = &*gpu_;
  EXPECT_THROW(measure("jnd_change", input), Error);
}

}  // namespace
}  // namespace limen::perception
