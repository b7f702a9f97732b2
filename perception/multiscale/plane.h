// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace limen::perception {

/// One channel in double precision, row by row from the top left.
struct Plane {
  int width = 0, height = 0;
  std::vector<double> data;

  Plane() = default;
  Plane(int w, int h, double value = 0.0)
      : width(w), height(h), data(static_cast<size_t>(w) * static_cast<size_t>(h), value) {}

  size_t pixels() const { return data.size(); }
  double* row(int y) { return data.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
  const double* row(int y) const { return data.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
  double& at(int x, int y) { return row(y)[x]; }
  double at(int x, int y) const { return row(y)[x]; }
};

/// Calls work(firstRow, endRow) on consecutive blocks of rows, on all cores if there is enough to do.
/// Blocks must not share what they write; what they write must not depend on where blocks end.
void forRowBlocks(int rows, size_t costPerRow, const std::function<void(int, int)>& work);

}  // namespace limen::perception
