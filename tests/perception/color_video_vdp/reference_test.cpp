// SPDX-License-Identifier: BSD-3-Clause
// ColorVideoVDP against what the authors' program gives in double precision (reference/README.md).
#include "perception/metrics/color_video_vdp/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "vectors.h"

namespace limen::perception::cvvdp {
namespace {

const Vector& vectorOf(const std::string& id) {
  static const std::vector<Vector> kVectors = readVectors();
  for (const Vector& v : kVectors)
    if (v.id == id) return v;
  throw std::out_of_range(id);
}

class CvvdpVectors : public testing::TestWithParam<std::string> {};

// 1e-9 JOD is what two programs in double precision can be expected to agree to; the table has 12 digits.
TEST_P(CvvdpVectors, ScoreIsTheAuthors) {
  const Vector& v = vectorOf(GetParam());
  // Printed to 17 digits; codes add up exactly, floating-point samples to a rounding in the last one.
  EXPECT_NEAR(v.sumOf(true), number(v.row, "sum_test"), 1e-12 * number(v.row, "sum_test"));
  EXPECT_NEAR(v.sumOf(false), number(v.row, "sum_ref"), 1e-12 * number(v.row, "sum_ref"));
  const Score score = evaluate(v.pair(), v.options).score;
  EXPECT_NEAR(score.jod, v.jod, 1e-9);
  EXPECT_NEAR(score.difference, v.difference, 1e-8 * v.difference);
  EXPECT_EQ(static_cast<double>(score.frequenciesCpd.size()), number(v.row, "bands"));
  if (v.jodFixed == v.jod) return;
  Options repaired = v.options;
  repaired.referenceBorders = false;
  EXPECT_NEAR(evaluate(v.pair(), repaired).score.jod, v.jodFixed, 1e-9);
}

std::vector<std::string> ids() {
  std::vector<std::string> out;
  for (const Vector& v : readVectors())
    if (v.id != "A17") out.push_back(v.id);  // 1920 x 1080 with the tests of the GPU's version
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, CvvdpVectors, testing::ValuesIn(ids()),
                         [](const testing::TestParamInfo<std::string>& id) { return id.param; });

}  // namespace
}  // namespace limen::perception::cvvdp
