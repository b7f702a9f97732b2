// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace limen::analysis {

struct Ranks {
  std::vector<double> ranks;     ///< from 1; equal values share the mean of theirs
  std::vector<double> tieSizes;  ///< of each group of equal values, including single ones, by ascending value
  std::vector<double> sharing;   ///< of each value, how many there are of it
};

inline Ranks rank(const std::vector<double>& values) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return values[a] < values[b]; });
  Ranks result{std::vector<double>(values.size()), {}, std::vector<double>(values.size())};
  for (size_t begin = 0; begin < order.size();) {
    size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (size_t i = begin; i < end; ++i) {
      result.ranks[order[i]] = 0.5 * static_cast<double>(begin + 1 + end);
      result.sharing[order[i]] = static_cast<double>(end - begin);
    }
    result.tieSizes.push_back(static_cast<double>(end - begin));
    begin = end;
  }
  return result;
}

}  // namespace limen::analysis
