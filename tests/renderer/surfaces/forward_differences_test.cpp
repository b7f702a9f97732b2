// SPDX-License-Identifier: BSD-3-Clause
// forward_differences.glsl against de Casteljau in double precision: how far runs drift, and what restarts leave (SC-72).
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/scene/shapes.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/surfaces/bezier_samples_bindings.h"

namespace limen::surfaces {
namespace {

constexpr int kCurves = 64;

struct Errors {
  double value = 0.0, slope = 0.0;  ///< largest; of control points within [-1, 1]
};

class ForwardDifferences : public gl::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    context();
    scene::Random random(29);
    for (int i = 0; i < 4 * kCurves; ++i)
      points_.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  }

  Errors errorsOf(int segments, int restart) const {
    gl::ProgramCache programs;
    const gl::Program& program = programs.compute("tests/renderer/surfaces/difference_samples.comp.glsl");
    const gl::Buffer points(points_), results(int64_t{kCurves} * (segments + 1) * 2 * 16, nullptr);
    points.bindStorage(kBezierPointsBuffer), results.bindStorage(kBezierResultsBuffer);
    program.use();
    program.set("count", kCurves);
    program.set("segments", segments);
    program.set("restart", restart);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    const std::vector<glm::vec4> found = results.read<glm::vec4>();
    Errors out;
    for (int curve = 0; curve < kCurves; ++curve)
      for (int i = 0; i <= segments; ++i) {
        std::array<glm::dvec4, 4> b;
        for (size_t k = 0; k < 4; ++k) b[k] = glm::dvec4(points_[size_t(4 * curve) + k]);
        const double t = double(i) / segments;
        for (size_t left = 3; left > 1; --left)
          for (size_t k = 0; k < left; ++k) b[k] = glm::mix(b[k], b[k + 1], t);
        const size_t at = 2 * size_t(curve * (segments + 1) + i);
        out.value = std::max(out.value, glm::length(glm::dvec4(found[at]) - glm::mix(b[0], b[1], t)));
        out.slope = std::max(out.slope, glm::length(glm::dvec4(found[at + 1]) - 3.0 * (b[1] - b[0])));
      }
    return out;
  }

  std::vector<glm::vec4> points_;
};

TEST_F(ForwardDifferences, DriftWithTheNumberOfSteps) {
  double last = 0.0;
  for (const int segments : {16, 64, 256, 1024, 4096}) {
    const Errors errors = errorsOf(segments, 1 << 20);
    RecordProperty("drift_" + std::to_string(segments), std::to_string(errors.value));
    if (segments >= 64) {
      EXPECT_GT(errors.value, last) << segments;
    }
    last = errors.value;
  }
  // Without restarts 4,096 steps are no use.
  EXPECT_GT(last, 1e-5);
}

/// 1e-5 of the control points' extent, at any number of steps.
TEST_F(ForwardDifferences, RestartsHoldTheErrorDown) {
  for (const int restart : {16, 64})
    for (const int segments : {16, 33, 64, 256, 1024, 4096}) {
      const Errors errors = errorsOf(segments, restart);
      EXPECT_LT(errors.value, 2e-5) << segments << " segments, restart " << restart;  // extent 2
      EXPECT_LT(errors.slope, 1e-4) << segments << " segments, restart " << restart;
    }
}

}  // namespace
}  // namespace limen::surfaces
