// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/bucket_sort.h"

#include <cassert>

#include "renderer/compute/reduction_forms.h"

namespace limen::compute {
namespace {

constexpr uint32_t kSortTile = uint32_t{kReductionGroup} * kReductionRows;

uint32_t tableSize(uint32_t most, int buckets) {
  return blocksOf(most, kSortTile) * static_cast<uint32_t>(buckets);
}

}  // namespace

BucketSort::BucketSort(gl::Context& context, uint32_t most, int buckets)
    : buckets_(buckets),
      most_(most),
      scan_(context, tableSize(most, buckets)),
      counts_(PrefixSum::bytesFor(tableSize(most, buckets), 1), nullptr),
      sums_(counts_.bytes(), nullptr) {
  assert(buckets >= 1 && buckets <= kMostBuckets && most <= kMostStreamItems);
  const auto program = [&](const char* stage) {
    return &context.programs().compute("renderer/compute/bucket_sort.comp.glsl",
                                       {{stage, "1"}, {"BUCKETS", std::to_string(buckets)}});
  };
  count_ = program("COUNT"), scatter_ = program("SCATTER");
}

void BucketSort::run(const gl::Buffer& items, const gl::Buffer& keys, uint32_t most, const gl::Buffer& sorted,
                     const gl::Buffer& starts) const {
  assert(most <= most_ && sorted.bytes() >= int64_t{most} * 4 && starts.bytes() >= (buckets_ + 1) * 4);
  const uint32_t tiles = blocksOf(most, kSortTile);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  const auto dispatch = [&](const gl::Program& program, const gl::Buffer& table) {
    items.bindStorage(kReductionItemsBuffer);
    keys.bindStorage(kReductionFlagsBuffer);
    sorted.bindStorage(kReductionOutBuffer);
    table.bindStorage(kReductionStateBuffer);
    starts.bindStorage(kReductionCountBuffer);
    program.use();
    program.set("count", most);
    program.set("tiles", tiles);
    dispatchGroups(tiles);
  };
  dispatch(*count_, counts_);
  scan_.run(counts_, sums_, tiles * static_cast<uint32_t>(buckets_));
  dispatch(*scatter_, sums_);
}

}  // namespace limen::compute
