// SPDX-License-Identifier: BSD-3-Clause
// ColorVideoVDP on the GPU against the authors' scores and against the version in double precision.
#include <gtest/gtest.h>

#include <cmath>

#include "perception/metrics/color_video_vdp/color_video_vdp_gpu.h"
#include "perception/metrics/color_video_vdp/reference.h"
#include "vectors.h"

namespace limen::perception::cvvdp {
namespace {

gl::Context& context() {
  static const std::unique_ptr<gl::Context> kContext = gl::createHeadlessContext();
  return *kContext;
}

const Vector& vectorOf(const std::string& id) {
  static const std::vector<Vector> kVectors = readVectors();
  for (const Vector& v : kVectors)
    if (v.id == id) return v;
  throw std::out_of_range(id);
}

class CvvdpGpuVectors : public testing::TestWithParam<std::string> {};

// 1e-4 JOD is a hundredth of what the authors' own single precision is off by at most, times ten.
TEST_P(CvvdpGpuVectors, ScoreIsTheAuthors) {
  const Vector& v = vectorOf(GetParam());
  EXPECT_NEAR(evaluateOnGpu(context(), v.pair(), v.options).jod, v.jod, 1e-4);
  context().checkDebugMessages();
}

std::vector<std::string> ids() {
  std::vector<std::string> out;
  for (const Vector& v : readVectors()) out.push_back(v.id);
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, CvvdpGpuVectors, testing::ValuesIn(ids()),
                         [](const testing::TestParamInfo<std::string>& id) { return id.param; });

}  // namespace
}  // namespace limen::perception::cvvdp
