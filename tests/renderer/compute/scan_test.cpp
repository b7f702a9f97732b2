// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/renderer/gl/gl_fixture.h"

namespace limen::compute {
namespace {

class Scans : public gl::GlTest {
 protected:
  template <class T>
  static std::vector<T> onGpu(const ScanSettings& settings, const std::vector<T>& values) {
    const Scan scan(context(), static_cast<uint32_t>(values.size()), settings);
    const gl::Buffer in(values), out(values);
    scan.run(in, out, static_cast<uint32_t>(values.size()));
    return out.read<T>(0, static_cast<int64_t>(values.size()));
  }
  static uint32_t joined(ScanOperator operation, uint32_t a, uint32_t b) {
    switch (operation) {
      case ScanOperator::Add:
        return a + b;
      case ScanOperator::Multiply:
        return a * b;
      case ScanOperator::Minimum:
        return std::min(a, b);
      default:
        return std::max(a, b);
    }
  }
  static constexpr ScanAlgorithm kAlgorithms[] = {ScanAlgorithm::HillisSteele, ScanAlgorithm::Blelloch};
};

TEST_F(Scans, EqualALoopForAnyCountAndOperator) {
  std::mt19937 random(3);
  for (const uint32_t count : {0U, 1U, 2U, 3U, 4U, 5U, 255U, 256U, 257U, 4095U, 4096U, 4097U, 70001U}) {
    std::vector<uint32_t> values(count);
    // Odd numbers: products stay different from 0.
    for (uint32_t& value : values) value = static_cast<uint32_t>(random()) | 1U;
    for (const auto& [operation, identity] : {std::pair{ScanOperator::Add, 0U},
                                              {ScanOperator::Multiply, 1U},
                                              {ScanOperator::Minimum, std::numeric_limits<uint32_t>::max()},
                                              {ScanOperator::Maximum, 0U}})
      for (const ScanRange range : {ScanRange::Inclusive, ScanRange::Exclusive}) {
        std::vector<uint32_t> expected;
        uint32_t sum = identity;
        for (const uint32_t value : values) {
          const uint32_t next = joined(operation, sum, value);
          expected.push_back(range == ScanRange::Inclusive ? next : sum);
          sum = next;
        }
        for (const ScanAlgorithm algorithm : kAlgorithms)
          ASSERT_EQ(onGpu<uint32_t>({algorithm, operation, ScanNumbers::Unsigned, range}, values), expected)
              << toText(algorithm) << ", " << toText(operation) << ", " << count << " values";
      }
  }
}

// Roger 2008, L1605: an exclusive scan of [x, x, ...] by multiplication gives the powers of x; their dot
// product with the coefficients is the polynomial. Here sum over k of (-1)^k x^k / k!, which is exp(-x). A
// power is a product of up to 40 factors in some order: its relative error is below 40 x 2^-24 = 2.4e-6, so
// that at x = 2 the sum is off by no more than exp(2) times that, 1.8e-5; what the series leaves out is below
// 2^40 / 40! < 1e-35.
TEST_F(Scans, EvaluateAPolynomial) {
  for (const ScanAlgorithm algorithm : kAlgorithms) {
    const std::vector<float> powers =
        onGpu<float>({algorithm, ScanOperator::Multiply, ScanNumbers::Float, ScanRange::Exclusive},
                     std::vector<float>(40, 2.0F));
    double sum = 0.0, coefficient = 1.0;
    for (size_t k = 0; k < powers.size(); ++k) {
      sum += coefficient * static_cast<double>(powers[k]);
      coefficient *= -1.0 / static_cast<double>(k + 1);
    }
    EXPECT_NEAR(sum, std::exp(-2.0), 1.8e-5) << toText(algorithm);
  }
}

TEST_F(Scans, KeepTheExtremesOfFloats) {
  const std::vector<float> values = {3.0F, -2.5F, 7.0F, -9.0F, 8.0F};
  for (const ScanAlgorithm algorithm : kAlgorithms) {
    const auto scanned = [&](ScanOperator operation) {
      return onGpu<float>({algorithm, operation, ScanNumbers::Float, ScanRange::Inclusive}, values);
    };
    EXPECT_EQ(scanned(ScanOperator::Minimum), (std::vector<float>{3.0F, -2.5F, -2.5F, -9.0F, -9.0F}));
    EXPECT_EQ(scanned(ScanOperator::Maximum), (std::vector<float>{3.0F, 3.0F, 7.0F, 7.0F, 8.0F}));
  }
}

// log2 n steps of Hillis and Steele, 2 log2 n of Blelloch, beside loading and storing.
TEST_F(Scans, TakeTheStepsOfTheirAlgorithm) {
  EXPECT_EQ(Scan(context(), 5000, {.algorithm = ScanAlgorithm::HillisSteele}).steps(4096), 2 + 12);
  EXPECT_EQ(Scan(context(), 5000, {.algorithm = ScanAlgorithm::Blelloch}).steps(4096), 2 + 24);
}

}  // namespace
}  // namespace limen::compute
