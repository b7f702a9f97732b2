// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>

namespace limen::perception {

/// Sum with a running compensation (Neumaier's form of Kahan's method): its error does not grow with the
/// count.
class CompensatedSum {
 public:
  void add(double value) {
    const double total = sum_ + value;
    compensation_ += std::abs(sum_) >= std::abs(value) ? (sum_ - total) + value : (value - total) + sum_;
    sum_ = total;
  }
  double value() const { return sum_ + compensation_; }

 private:
  double sum_ = 0.0, compensation_ = 0.0;
};

/// Calls work(row) once for each row, on all cores if there is enough to do. Rows must not write to shared
/// data. An exception in a row is passed on to the caller.
void forEachRow(int rows, size_t pixelsPerRow, const std::function<void(int)>& work);

/// Sum of rowSum(row), added in the order of the rows whatever the number of cores.
double sumRows(int rows, size_t pixelsPerRow, const std::function<double(int)>& rowSum);

}  // namespace limen::perception
