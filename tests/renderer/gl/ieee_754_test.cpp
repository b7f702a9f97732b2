// SPDX-License-Identifier: BSD-3-Clause
// Floats are IEEE 754 numbers on the CPU and on the GPU (Holländer 2013, section 7.3).
#include <epoxy/gl.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "renderer/gl/buffer.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/gl/ieee_754_bindings.h"

namespace limen::gl {
namespace {

class Ieee754 : public GlTest {};

// Printed in Holländer 2013, listing 7.1: all numbers from 0.5 to below 1 have the exponent 126, and 1 has
// 127.
TEST_F(Ieee754, NumbersBelowOneHaveTheExponentBefore) {
  struct Printed {
    float number;
    uint32_t exponent, mantissa;
  };
  const std::vector<Printed> printed = {{0.99999994F, 126, 8388607}, {0.5F, 126, 0}, {1.0F, 127, 0}};
  std::vector<float> numbers;
  for (const Printed& each : printed) numbers.push_back(each.number);
  const Buffer in(numbers), out(int64_t{4} * int64_t(numbers.size()), nullptr);
  const Program& program = context().programs().compute("tests/renderer/gl/ieee_754.comp.glsl");
  program.set("scale", 1.0F);
  in.bindStorage(kIeeeNumbersBuffer);
  out.bindStorage(kIeeeBitsBuffer);
  program.dispatch({int(numbers.size()), 1}, {1, 1});
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const std::vector<uint32_t> onGpu = out.read<uint32_t>();
  for (size_t i = 0; i < printed.size(); ++i) {
    const uint32_t expected = printed[i].exponent << 23U | printed[i].mantissa;
    EXPECT_EQ(std::bit_cast<uint32_t>(printed[i].number), expected);
    EXPECT_EQ(onGpu[i], expected);
  }
}

}  // namespace
}  // namespace limen::gl
