// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace limen::scene {

/// A sparse stream: what stream reduction packs, and bucket sort distributes.
struct ItemStream {
  static constexpr uint32_t kInvalid = 0xffffffffU;
  std::vector<uint32_t> items;  ///< an item's number if it is valid, otherwise kInvalid
  std::vector<uint32_t> keys;   ///< of each item, below `buckets`
  uint32_t buckets = 1;
};

}  // namespace limen::scene
