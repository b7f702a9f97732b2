// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/run_lengths.h"

#include <algorithm>

namespace limen::visibility_fields {

std::vector<uint8_t> encodeRuns(std::span<const uint8_t> bytes) {
  constexpr size_t kLongest = 256;
  std::vector<uint8_t> runs;
  for (size_t at = 0; at < bytes.size();) {
    size_t length = 1;
    while (length < kLongest && at + length < bytes.size() && bytes[at + length] == bytes[at]) ++length;
    runs.push_back(static_cast<uint8_t>(length - 1));
    runs.push_back(bytes[at]);
    at += length;
  }
  return runs;
}

std::vector<uint8_t> decodeRuns(std::span<const uint8_t> runs) {
  std::vector<uint8_t> bytes;
  for (size_t at = 0; at + 1 < runs.size(); at += 2)
    bytes.insert(bytes.end(), size_t{runs[at]} + 1, runs[at + 1]);
  return bytes;
}

void lengthenRuns(std::span<uint8_t> codes, int tolerance, uint8_t kept) {
  for (size_t first = 0; first < codes.size();) {
    if (codes[first] == kept) {
      ++first;
      continue;
    }
    int low = codes[first], high = codes[first];
    size_t end = first + 1;
    for (; end < codes.size() && codes[end] != kept; ++end) {
      const int code = codes[end];
      if (std::max(high, code) - std::min(low, code) > 2 * tolerance) break;
      low = std::min(low, code), high = std::max(high, code);
    }
    std::fill(codes.begin() + static_cast<std::ptrdiff_t>(first),
              codes.begin() + static_cast<std::ptrdiff_t>(end), static_cast<uint8_t>((low + high) / 2));
    first = end;
  }
}

}  // namespace limen::visibility_fields
