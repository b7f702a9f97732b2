// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "experiments/base/enum_names.h"
#include "renderer/compute/stream_reduction.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"

namespace limen::compute {

enum class ScanOperator { Add, Multiply, Minimum, Maximum };
constexpr EnumNames<ScanOperator, 4> enumNames(ScanOperator) {
  return {{{{ScanOperator::Add, "add"},
            {ScanOperator::Multiply, "multiply"},
            {ScanOperator::Minimum, "minimum"},
            {ScanOperator::Maximum, "maximum"}}}};
}

enum class ScanNumbers { Unsigned, Float };  ///< 32 bits each
/// Whether results[i] includes values[i]; both have as many results as values, results[0] of Exclusive being
/// the operator's identity.
enum class ScanRange { Inclusive, Exclusive };

struct ScanSettings {
  ScanAlgorithm algorithm = ScanAlgorithm::Blelloch;
  ScanOperator operation = ScanOperator::Add;
  ScanNumbers numbers = ScanNumbers::Unsigned;
  ScanRange range = ScanRange::Inclusive;
};

/// Scans with an associative operator over whole arrays on the GPU, one dispatch a step (Roger 2008, section
/// 4.1). They read and write memory in each step: for sums, PrefixSum is many times faster. Unsigned sums and
/// products are modulo 2^32; those of floats are rounded in an order that depends on the algorithm alone.
class Scan {
 public:
  Scan(gl::Context& context, uint32_t capacity, const ScanSettings& settings);

  /// Different buffers, of at least 4 x count bytes. Issues barriers for shader storage before, between and
  /// after its dispatches. Nothing waits for the GPU. Binds storage buffers 0 to 3.
  void run(const gl::Buffer& values, const gl::Buffer& results, uint32_t count) const;

  /// Dispatches of a run.
  int steps(uint32_t count) const;
  int64_t bytes() const { return work_[0].bytes() + work_[1].bytes(); }

 private:
  ScanSettings settings_;
  uint32_t capacity_;
  const gl::Program *load_, *store_, *step_, *down_;
  std::array<gl::Buffer, 2> work_;
};

}  // namespace limen::compute
