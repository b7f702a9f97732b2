// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "experiments/base/enum_names.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"

namespace limen::compute {

/// How a prefix sum is made.
enum class ScanForm {
  Auto,            ///< LookBack on a GPU, ReduceThenScan on a software renderer
  ReduceThenScan,  ///< sums of tiles, sums over these, sums within tiles: three dispatches
  /// One dispatch: a tile waits for the sums of those before it (Merrill and Garland 2016). OpenGL does not
  /// promise that the groups of those make progress; after waiting in vain for a while a group adds up the
  /// other's tile itself (Levien 2020), so that it ends on any device.
  LookBack
};
constexpr EnumNames<ScanForm, 3> enumNames(ScanForm) {
  return {{{{ScanForm::Auto, "auto"},
            {ScanForm::LookBack, "look_back"},
            {ScanForm::ReduceThenScan, "reduce_then_scan"}}}};
}

/// Exclusive prefix sums of unsigned numbers on the GPU, of one sequence or of two at a time whose elements
/// alternate (uvec2). Sums saturate: 0xffffffff says that the true one does not fit.
class PrefixSum {
 public:
  static constexpr uint32_t kOverflow = 0xffffffffU;

  /// Of at most `capacity` elements of `lanes` (1 or 2) numbers.
  PrefixSum(gl::Context& context, uint32_t capacity, int lanes = 1, ScanForm form = ScanForm::Auto);

  /// sums[i] = values[0] + ... + values[i - 1] for 0 <= i <= count, so that the last is the total. Different
  /// buffers, of at least bytesFor(count, lanes) bytes. Issues barriers for shader storage before, between
  /// and after its dispatches. Nothing waits for the GPU.
  void run(const gl::Buffer& values, const gl::Buffer& sums, uint32_t count) const;

  ScanForm form() const { return form_; }
  int64_t bytes() const { return tiles_.bytes() + state_.bytes(); }
  static int64_t bytesFor(uint32_t count, int lanes) {
    return ((int64_t{count} + 1) * lanes * 4 + 15) / 16 * 16;
  }

 private:
  uint32_t tilesOf(uint32_t count) const;

  ScanForm form_;
  int lanes_;
  uint32_t capacity_;
  const gl::Program *first_ = nullptr, *second_ = nullptr, *third_ = nullptr, *alone_ = nullptr;
  gl::Buffer tiles_, state_;
  mutable bool odd_ = false;  // looks back so far
};

}  // namespace limen::compute
