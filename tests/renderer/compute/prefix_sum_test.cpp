// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/prefix_sum.h"

#include <random>

#include "tests/renderer/gl/gl_fixture.h"

namespace limen::compute {
namespace {

class PrefixSums : public gl::GlTest {
 protected:
  static std::vector<uint32_t> padded(std::vector<uint32_t> values, uint32_t count, int lanes,
                                      uint32_t with) {
    values.resize(static_cast<size_t>(PrefixSum::bytesFor(count, lanes) / 4), with);
    return values;
  }
  /// `values`: count elements of `lanes` numbers; what follows them is filled with numbers that must not
  /// count.
  static std::vector<uint32_t> onGpu(const PrefixSum& scan, const std::vector<uint32_t>& values, int lanes) {
    const uint32_t count = static_cast<uint32_t>(values.size()) / uint32_t(lanes);
    const gl::Buffer in(padded(values, count, lanes, 77777)), out(padded({}, count, lanes, 55555));
    scan.run(in, out, count);
    return out.read<uint32_t>(0, int64_t{count + 1} * lanes);
  }
  static std::vector<uint32_t> onCpu(const std::vector<uint32_t>& values, int lanes) {
    std::vector<uint64_t> sums(static_cast<size_t>(lanes));
    std::vector<uint32_t> out;
    for (size_t i = 0; i <= values.size(); ++i) {
      const size_t lane = i % size_t(lanes);
      if (i < values.size() + size_t(lanes))
        out.push_back(uint32_t(std::min<uint64_t>(sums[lane], 0xffffffffU)));
      if (i < values.size()) sums[lane] += values[i];
    }
    for (size_t i = out.size(); i < values.size() + size_t(lanes); ++i)
      out.push_back(uint32_t(std::min<uint64_t>(sums[i % size_t(lanes)], 0xffffffffU)));
    return out;
  }
  static std::vector<uint32_t> anyValues(size_t count, uint32_t most) {
    std::mt19937 random(uint32_t(count) + 1);
    std::vector<uint32_t> out(count);
    for (uint32_t& value : out) value = std::uniform_int_distribution<uint32_t>(0, most)(random);
    return out;
  }
};

TEST_F(PrefixSums, EqualThoseOfTheCpuForAnyCount) {
  for (const ScanForm form : {ScanForm::ReduceThenScan, ScanForm::LookBack})
    for (const int lanes : {1, 2}) {
      const PrefixSum scan(context(), 1 << 20, lanes, form);
      for (const uint32_t count :
           {0U,    1U,    2U,    3U,    4U,    5U,     255U,   256U,    1023U,    1024U,   1025U,
            2047U, 2048U, 4095U, 4096U, 4097U, 12345U, 65537U, 262144U, 1048573U, 1U << 20}) {
        const std::vector<uint32_t> values = anyValues(size_t(count) * size_t(lanes), 1000);
        ASSERT_EQ(onGpu(scan, values, lanes), onCpu(values, lanes))
            << toText(form) << ", " << count << " elements of " << lanes;
      }
    }
}

TEST_F(PrefixSums, SayThatASumDoesNotFit) {
  for (const ScanForm form : {ScanForm::ReduceThenScan, ScanForm::LookBack}) {
    const PrefixSum scan(context(), 100000, 1, form);
    // 0xffffffff / 50000 = 85899.3: sums of 50,000 such numbers fit by themselves, but not of 60,000.
    const std::vector<uint32_t> values(60000, 85899);
    const std::vector<uint32_t> sums = onGpu(scan, values, 1);
    EXPECT_EQ(sums, onCpu(values, 1));
    EXPECT_EQ(sums[50000], 85899U * 50000U);
    EXPECT_EQ(sums[60000], PrefixSum::kOverflow);
    // Even if tiles' sums wrap around more than once.
    const std::vector<uint32_t> large(60000, 0xf0000000U);
    EXPECT_EQ(onGpu(scan, large, 1), onCpu(large, 1));
  }
}

TEST_F(PrefixSums, AreTheSameTwice) {
  const std::vector<uint32_t> values = anyValues(100001, 5);
  for (const ScanForm form : {ScanForm::ReduceThenScan, ScanForm::LookBack}) {
    const PrefixSum scan(context(), 200000, 1, form);
    const std::vector<uint32_t> once = onGpu(scan, values, 1);
    EXPECT_EQ(onGpu(scan, values, 1), once);
  }
}

TEST_F(PrefixSums, DoNotRelyOnProgressOnSoftwareRenderers) {
  const PrefixSum scan(context(), 10);
  if (context().device().software) {
    EXPECT_EQ(scan.form(), ScanForm::ReduceThenScan);
  }
}

}  // namespace
}  // namespace limen::compute
