// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "renderer/compute/prefix_sum.h"
#include "renderer/compute/reduction_bindings.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"

namespace limen::compute {

inline constexpr int kMostBuckets = 16;

/// Distributes the valid items of a stream to buckets, in their order within each (Roger 2008, section 4.5):
/// as many reductions as there are buckets, all of whose prefix sums are made at once. Where the thesis
/// searches, items are scattered, which takes one pass for all buckets.
class BucketSort {
 public:
  /// Of at most `most` items, `buckets` from 1 to kMostBuckets.
  BucketSort(gl::Context& context, uint32_t most, int buckets);

  /// `items`: a word each, kInvalidItem if invalid. `keys`: each item's bucket; an item whose key is no
  /// bucket is invalid. `sorted` gets the items of bucket 0, then those of bucket 1, and so on; `starts`
  /// (buckets + 1 words) where each begins and the last ends. Different buffers; all but `starts` have room
  /// for `most` words. Issues barriers for shader storage before, between and after its dispatches. Binds
  /// storage buffers 0 to 5.
  void run(const gl::Buffer& items, const gl::Buffer& keys, uint32_t most, const gl::Buffer& sorted,
           const gl::Buffer& starts) const;

  int64_t bytes() const { return scan_.bytes() + counts_.bytes() + sums_.bytes(); }

 private:
  int buckets_;
  uint32_t most_;
  PrefixSum scan_;
  gl::Buffer counts_, sums_;
  const gl::Program *count_, *scatter_;
};

}  // namespace limen::compute
