// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cassert>

#include "study/protocol/design.h"

namespace limen::study {

// The first row 0, 1, n-1, 2, n-2, ... has every difference of neighbours (modulo n) once for n even, and
// every one up to sign once for n odd, where the mirrored rows have the other sign (Williams 1949; Bradley
// 1958). Row r adds r to it.
std::vector<int> williamsRow(int treatments, int row) {
  assert(treatments > 0 && row >= 0);
  const int n = treatments, period = n % 2 == 0 ? n : 2 * n;
  row %= period;
  std::vector<int> out;
  for (int i = 0; i < n; ++i) {
    const int step = i % 2 == 1 ? (i + 1) / 2 : (n - i / 2) % n;
    out.push_back((step + row) % n);
  }
  if (row >= n) std::reverse(out.begin(), out.end());
  return out;
}

std::vector<int> latinRow(int treatments, int row) {
  assert(treatments > 0 && row >= 0);
  std::vector<int> out;
  for (int i = 0; i < treatments; ++i) out.push_back((row % treatments + i) % treatments);
  return out;
}

}  // namespace limen::study
